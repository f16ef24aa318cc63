// A module under test without YAML: room, helicopter and camera are defined in code, and the module has no config.
#include <cstdio>
#include <exception>
#include <memory>
#include <string>

#include "sim/simulation/simulation.h"

using namespace hedgehop;

namespace {

/// Turns on the spot, faster for a darker image.
class Moth : public avoidance::Module {
  avoidance::Needs do_needs() const override { return {{{"front"}}}; }
  void do_reset(const avoidance::Setup&) override {}
  avoidance::Decision do_update(const avoidance::Observation& seen) override {
    const double grey = seen.frames.empty() ? 0.0 : cv::mean(seen.frames.front().image)[0];
    return {avoidance::HoverCommand{1.0 - grey / 255.0}, "turn", {}};
  }
};

sim::Scenario room() {
  sim::Scenario scenario;
  scenario.name = "moth";
  scenario.duration_s = 4.0;
  scenario.scene = scenes::worlds::RoomConfig{};
  scenario.vehicle = dynamics::multicopter::MulticopterConfig{};
  scenario.start.altitude_m = 1.0;
  scenario.rig.cameras = {{.role = "front", .width_px = 64, .height_px = 48}};
  scenario.velocimeter.enabled = false;
  return scenario;
}

}  // namespace

int main() {
  try {
    sim::Simulation simulation(room(), [] { return std::make_unique<Moth>(); });
    const sim::Flight flight = simulation.run();
    std::printf("%s; turned from %.2f to %.2f rad\n", std::string(sim::to_string(flight.result.outcome)).c_str(),
                flight.trajectory.front().rpy_true.z(), flight.trajectory.back().rpy_true.z());
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    return 2;
  }
}
