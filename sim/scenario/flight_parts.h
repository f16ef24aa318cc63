#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dynamics/air/wind.h"
#include "dynamics/avionics.h"
#include "dynamics/hull.h"
#include "dynamics/vehicle.h"
#include "scenes/scene.h"
#include "sim/scenario/inputs.h"
#include "sim/scenario/scenario.h"

/// The parts of a flight that follow from the scenario's parameters alone. A part is built once: the reader builds it
/// to check its parameters, and the flight uses what the reader built.
namespace hedgehop::avoidance {
class Module;
struct Setup;
}  // namespace hedgehop::avoidance

namespace hedgehop::sim {

struct Node;

/// The vehicle, its air and its avionics.
struct AircraftParts {
  dynamics::Vehicle vehicle;
  dynamics::air::Wind wind;
  dynamics::Avionics avionics;
};

struct FlightParts {
  FlightParts(AircraftParts flies, std::unique_ptr<avoidance::Module> decides);
  FlightParts(FlightParts&&) noexcept;
  FlightParts& operator=(FlightParts&&) noexcept;
  ~FlightParts();

  AircraftParts aircraft;
  std::unique_ptr<avoidance::Module> module;  ///< null for a module of a shared library, which the flight loads
};

/// A scenario, its parts, and the files it depends on. Who changes a parameter of a part afterwards, or the seed,
/// builds the parts again.
struct LoadedScenario {
  Scenario scenario;
  FlightParts parts;
  Inputs inputs;
  std::shared_ptr<const Node> root;  ///< what it was read from
};

/// Returns the errors with the positions of their fields before them.
/// @param root  of the scenario; null returns the errors unchanged.
InputError at_positions(const Node* root, const InputError& error);

/// Reads a scenario, as strictly as load_scenario(), and keeps the parts that were built to check it.
/// @param seed  replaces the file's. Throws InputError with every fault found.
LoadedScenario load_flight(const std::filesystem::path& file, std::span<const std::string> overrides = {},
                           std::optional<uint64_t> seed = {});
/// As above, of a text instead of a file; its paths are relative to the working folder.
LoadedScenario load_flight_text(const std::string& yaml, std::span<const std::string> overrides = {},
                                std::optional<uint64_t> seed = {});

/// Build the parts of a valid scenario. Throw InputError with the path of a part that cannot be built.
FlightParts build_parts(const Scenario& scenario);
AircraftParts build_aircraft(const Scenario& scenario);

/// Builders of single parts. Throw std::invalid_argument on values that cannot be.
dynamics::air::Wind build_wind(const Scenario& scenario);
/// @param carrier  the vehicle that the autopilot is designed for.
dynamics::Avionics build_avionics(const Scenario& scenario, const dynamics::VehicleConfig& carrier);

/// What a module is told before its flight. @param hull  of the vehicle.
avoidance::Setup module_setup(const Scenario& scenario, const std::vector<dynamics::HullPart>& hull);
/// As above, of the scenario's own vehicle.
avoidance::Setup module_setup(const Scenario& scenario);

/// The scene of a flight, by the run's own seed. Throws std::invalid_argument on a scene that cannot be.
scenes::Scene build_scene(const scenes::SceneConfig& config, uint64_t run_seed);

}  // namespace hedgehop::sim
