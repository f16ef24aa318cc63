#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "dynamics/steady_flight.h"
#include "sim/fields/quantities.h"
#include "sim/scenario/scenario.h"
#include "tests/dynamics/control/step_response.h"
#include "tests/dynamics/multicopter/published_multicopters.h"

namespace hedgehop::sim {
namespace {

std::vector<std::filesystem::path> vehicle_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(HEDGEHOP_SOURCE_DIR "/configs/vehicles")) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

class VehicleFile : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(VehicleFile, HoversAndFliesForwardsAndBackwardsInTrim) {
  const dynamics::VehicleConfig vehicle = load_vehicle(GetParam());
  for (const double speed_mps : {-4.0, 0.0, 4.0, 8.0}) {
    const auto flight = dynamics::steady_flight(vehicle, {speed_mps, 0.0, 0.0});
    ASSERT_TRUE(flight) << speed_mps;
    // The nose goes down to fly forwards.
    EXPECT_LE(flight->pitch_rad * speed_mps, 0.0) << speed_mps;
    EXPECT_EQ(std::abs(flight->pitch_rad) > 1e-3, speed_mps != 0.0) << speed_mps;
  }
}

// The properties are the table of step responses in docs/verification.md.
TEST_P(VehicleFile, FollowsAVelocityStepOfTwoMetersPerSecond) {
  dynamics::Loop loop;
  loop.perfect = true;
  loop.vehicle = load_vehicle(GetParam());
  for (const bool sideways : {false, true}) {
    const dynamics::StepResponse r =
        dynamics::step_response(loop, sideways ? Eigen::Vector2d(0.0, 2.0) : Eigen::Vector2d(2.0, 0.0));
    const std::string way = sideways ? "sideways_" : "forwards_";
    const auto record = [&](const std::string& what, double value) {
      RecordProperty(way + what, std::to_string(value));
    };
    record("rise_s", r.rise_s);
    record("settled_s", r.settled_s);
    record("overshoot_percent", 100.0 * r.overshoot);
    record("across_mps", r.across_mps);
    record("altitude_m", r.altitude_m);
    record("heading_deg", r.heading_rad * kDegPerRad);
    EXPECT_LT(r.rise_s, 1.6) << way;
    EXPECT_LT(r.settled_s, 2.5) << way;
    EXPECT_LT(r.overshoot, 0.1) << way;
    EXPECT_LT(r.across_mps, 0.15) << way;
    EXPECT_LT(r.altitude_m, 0.2) << way;
    EXPECT_LT(r.heading_rad * kDegPerRad, 3.0) << way;
  }
}

// The checks of the published parameter sets hold for the files that are flown.
TEST(MulticopterFiles, HoldThePublishedParameters) {
  const std::vector<std::pair<std::string, dynamics::multicopter::MulticopterConfig>> published = {
      {"hummingbird", dynamics::hummingbird_a()}, {"firefly", dynamics::firefly()}, {"s900", dynamics::s900()}};
  for (const auto& [name, config] : published) {
    SCOPED_TRACE(name);
    const auto flown = std::get<dynamics::multicopter::MulticopterConfig>(
        load_vehicle(HEDGEHOP_SOURCE_DIR "/configs/vehicles/" + name + ".yaml"));
    const dynamics::multicopter::MulticopterModel a = make_model(flown), b = make_model(config);
    ASSERT_EQ(a.rotors.size(), b.rotors.size());
    EXPECT_LT((a.wrench_of_thrusts - b.wrench_of_thrusts).norm(), 1e-12);
    EXPECT_EQ(a.mass.mass_kg, b.mass.mass_kg);
    EXPECT_LT((a.mass.I_B - b.mass.I_B).norm(), 1e-12);
    EXPECT_EQ(a.body_drag_ns2pm2, b.body_drag_ns2pm2);
    const dynamics::multicopter::LiftRotorConfig &x = a.rotor, &y = b.rotor;
    EXPECT_EQ(x.thrust_ns2, y.thrust_ns2);
    EXPECT_EQ(x.drag_ns2pm, y.drag_ns2pm);
    EXPECT_EQ(x.rolling_nms2pm, y.rolling_nms2pm);
    EXPECT_EQ(x.axial_damping_ns2pm, y.axial_damping_ns2pm);
    EXPECT_EQ(x.translational_lift_ns2pm2, y.translational_lift_ns2pm2);
    EXPECT_EQ(x.time_constant_up_s, y.time_constant_up_s);
    EXPECT_EQ(x.time_constant_down_s, y.time_constant_down_s);
    EXPECT_EQ(x.highest_radps, y.highest_radps);
    EXPECT_EQ(x.inertia_kgm2, y.inertia_kgm2);
    EXPECT_EQ(x.radius_m, y.radius_m);
  }
}

INSTANTIATE_TEST_SUITE_P(All, VehicleFile, testing::ValuesIn(vehicle_files()),
                         [](const auto& tested) { return tested.param.stem().string(); });

}  // namespace
}  // namespace hedgehop::sim
