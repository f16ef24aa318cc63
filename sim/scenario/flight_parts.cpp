#include "sim/scenario/flight_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

#include "avoidance/module.h"
#include "sim/config/tree.h"
#include "sim/fields/bounds.h"
#include "sim/libm/random.h"

namespace hedgehop::sim {
namespace {

/// Whether a fault begins with its place, as those of a plugin's parameters do: "--set KEY: " or "file:line:column: ".
bool has_place(std::string_view fault) {
  const std::string_view place = fault.substr(0, fault.find(": "));
  return place.starts_with("--set ") || (place.size() > 1 && std::isdigit(static_cast<unsigned char>(place.back())) &&
                                         std::ranges::count(place, ':') >= 2);
}

}  // namespace

FlightParts::FlightParts(AircraftParts flies, std::unique_ptr<avoidance::Module> decides)
    : aircraft(std::move(flies)), module(std::move(decides)) {}
FlightParts::FlightParts(FlightParts&&) noexcept = default;
FlightParts& FlightParts::operator=(FlightParts&&) noexcept = default;
FlightParts::~FlightParts() = default;

dynamics::air::Wind build_wind(const Scenario& scenario) { return {scenario.wind, stream_seed(scenario.seed, "wind")}; }

dynamics::Avionics build_avionics(const Scenario& scenario, const dynamics::VehicleConfig& carrier) {
  return {scenario.avionics, carrier, 1.0 / static_cast<double>(scenario.physics_rate_hz),
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

InputError placed(const Node* root, const InputError& faults) {
  if (!root) return faults;
  std::vector<std::string> lines;
  for (const std::string& fault : faults.faults()) {
    if (has_place(fault)) {
      lines.push_back(fault);
      continue;
    }
    std::string path = "rig";
    if (fault.starts_with('\''))
      path = fault.substr(1, fault.find('\'', 1) - 1);
    else if (!fault.starts_with("camera '"))
      path.clear();
    // The key, where a generator's message names one.
    const size_t key = path.size() + 4, end = fault.find(": ", key);
    if (fault.starts_with('\'') && end != std::string::npos && fault.find(' ', key) > end) {
      path = join_path(path, fault.substr(key, end - key));
    }
    lines.push_back(fmt::format("{}: {}", place_of(*root, path).text(), fault));
  }
  return InputError(std::move(lines));
}

scenes::Scene build_scene(const scenes::SceneConfig& config, uint64_t run_seed) {
  return scenes::make_scene(config, stream_seed(run_seed, kSceneStream));
}

AircraftParts build_aircraft(const Scenario& scenario) {
  return {build_part("vehicle", [&] { return dynamics::Vehicle(scenario.vehicle); }),
          build_part("wind", [&] { return build_wind(scenario); }),
          build_part("avionics", [&] { return build_avionics(scenario, scenario.vehicle); })};
}

FlightParts build_parts(const Scenario& scenario) {
  build_part("scenario", [&] { return &fields::require_bounds(scenario); });
  return {build_aircraft(scenario), build_part("avoidance", [&] { return scenario.avoidance.make(); })};
}

}  // namespace hedgehop::sim
