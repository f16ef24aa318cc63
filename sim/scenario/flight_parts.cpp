#include "sim/scenario/flight_parts.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "avoidance/module.h"
#include "sim/config/config_tree.h"
#include "sim/fields/bounds.h"
#include "sim/libm/random.h"

namespace hedgehop::sim {

FlightParts::FlightParts(AircraftParts flies, std::unique_ptr<avoidance::Module> decides)
    : aircraft(std::move(flies)), module(std::move(decides)) {}
FlightParts::FlightParts(FlightParts&&) noexcept = default;
FlightParts& FlightParts::operator=(FlightParts&&) noexcept = default;
FlightParts::~FlightParts() = default;

dynamics::air::Wind build_wind(const Scenario& scenario) { return {scenario.wind, stream_seed(scenario.seed, "wind")}; }

dynamics::Avionics build_avionics(const Scenario& scenario, const dynamics::VehicleConfig& carrier) {
  return {scenario.avionics, carrier, 1.0 / static_cast<double>(scenario.physics_rate_hz.value()),
          [&](std::string_view name) { return stream_seed(scenario.seed, name); },
          sensor_failures(scenario.failures, scenario.seed)};
}

avoidance::Setup module_setup(const Scenario& scenario, const std::vector<dynamics::HullPart>& hull) {
  const dynamics::control::AutopilotConfig& limits = scenario.avionics.autopilot;
  avoidance::Setup setup{.limits = {limits.speed_limit_mps, limits.acceleration_limit_mps2, dynamics::radius_m(hull)},
                         .seed = stream_seed(scenario.seed, "module")};
  for (const dynamics::HullPart& part : hull) {
    setup.limits.outline_B.emplace_back(part.center_B_m - part.half_extents_m, part.center_B_m + part.half_extents_m);
  }
  if (const auto& band = scenario.altitude_band) setup.altitude_band = {band->min_m, band->max_m};
  for (const CameraConfig& camera : scenario.rig.cameras) {
    setup.cameras.push_back({camera.role, camera.model(), camera.X_BC(), camera.rate_hz});
  }
  return setup;
}

avoidance::Setup module_setup(const Scenario& scenario) {
  return module_setup(scenario, dynamics::hull(scenario.vehicle));
}

InputError at_positions(const Node* root, const InputError& error) {
  if (!root || error.field_errors().empty()) return error;
  std::vector<std::string> lines;
  for (const FieldError& field : error.field_errors()) {
    lines.push_back(fmt::format("{}: {}", position_of(*root, field.path).text(), field.text()));
  }
  return InputError(lines);
}

scenes::SceneFiles read_scene_files(const scenes::SceneConfig& config, uint64_t world_seed) {
  return scenes::read_scene_files(config, stream_seed(world_seed, kSceneStream));
}

scenes::Scene build_scene(const scenes::SceneConfig& config, uint64_t world_seed) {
  return scenes::make_scene(config, stream_seed(world_seed, kSceneStream));
}

scenes::Scene build_scene(const scenes::SceneConfig& config, uint64_t world_seed, scenes::SceneFiles files) {
  return scenes::make_scene(config, stream_seed(world_seed, kSceneStream), std::move(files));
}

AircraftParts build_aircraft(const Scenario& scenario) {
  return {build_part("vehicle", [&] { return dynamics::Vehicle(scenario.vehicle); }),
          build_part("wind", [&] { return build_wind(scenario); }),
          build_part("avionics", [&] { return build_avionics(scenario, scenario.vehicle); })};
}

FlightParts build_parts(const Scenario& scenario) {
  return {build_aircraft(scenario), build_part("avoidance", [&] { return scenario.avoidance.make(); })};
}

}  // namespace hedgehop::sim
