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
#include "scenes/scene_files.h"
#include "sim/scenario/inputs.h"
#include "sim/scenario/scenario.h"

/// The parts of a flight that depend on the scenario's parameters only. Each part is built once: validation builds it
/// to check its parameters, and the flight uses it.
namespace hedgehop::avoidance {
class Module;
struct Setup;
}  // namespace hedgehop::avoidance

namespace hedgehop::sim {

struct Node;

/// The vehicle, its wind and its avionics.
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
  std::unique_ptr<avoidance::Module> module;  ///< null for a foreign module, which the flight loads
  scenes::SceneFiles files;                   ///< of the scene; empty in parts from build_parts()
};

/// A scenario, its parts, and the files it depends on. After a change of the scenario, the parts must be built again.
struct LoadedScenario {
  Scenario scenario;
  FlightParts parts;
  Inputs inputs;
  std::shared_ptr<const Node> root;  ///< the input as read
};

/// Returns the errors with the positions of their fields before them.
/// @param root  of the scenario; null returns the errors unchanged.
InputError at_positions(const Node* root, const InputError& error);

/// Reads a scenario as strictly as load_scenario(), and returns the parts that its validation built.
/// @param seed  replaces the file's. Throws InputError with every error found.
LoadedScenario load_flight(const std::filesystem::path& file, std::span<const std::string> overrides = {},
                           std::optional<uint64_t> seed = {});
/// As above, from a text instead of a file; its paths are relative to the working folder.
LoadedScenario load_flight_text(const std::string& yaml, std::span<const std::string> overrides = {},
                                std::optional<uint64_t> seed = {});

/// Build the parts of a valid scenario, for another flight in the same scene. Throw InputError with the path of a part
/// that cannot be built.
FlightParts build_parts(const Scenario& scenario);
AircraftParts build_aircraft(const Scenario& scenario);

/// Build single parts. Throw std::invalid_argument on invalid values.
dynamics::air::Wind build_wind(const Scenario& scenario);
/// @param carrier  vehicle for which the autopilot is designed.
dynamics::Avionics build_avionics(const Scenario& scenario, const dynamics::VehicleConfig& carrier);

/// Returns the setup of a module before its flight. @param hull  of the vehicle.
avoidance::Setup module_setup(const Scenario& scenario, const std::vector<dynamics::HullPart>& hull);
/// As above, for the scenario's own vehicle.
avoidance::Setup module_setup(const Scenario& scenario);

/// Reads the files of the scene of a flight. @param world_seed  Scenario::world().
/// Throws std::invalid_argument that begins with the faulty key.
scenes::SceneFiles read_scene_files(const scenes::SceneConfig& config, uint64_t world_seed);

/// Returns the scene of a flight. @param world_seed  Scenario::world(). Throws std::invalid_argument on an invalid
/// scene.
scenes::Scene build_scene(const scenes::SceneConfig& config, uint64_t world_seed);
/// As above. @param files  from read_scene_files() for the same arguments.
scenes::Scene build_scene(const scenes::SceneConfig& config, uint64_t world_seed, scenes::SceneFiles files);

}  // namespace hedgehop::sim
