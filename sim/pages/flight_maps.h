#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "sim/pages/plan.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// A flight on a map with many flights: its scene, and its path in plan view.
struct FlownPath {
  scenes::SceneConfig scene;
  uint64_t seed = 0;
  std::optional<GoalConfig> goal;
  std::vector<Eigen::Vector2d> p_NE_m;     ///< simplified; empty if the trajectory is empty
  double lowest_m = 0.0, highest_m = 0.0;  ///< altitudes
};

/// Returns the path from scenario.yaml and trajectory.csv of a flight; none if a file is missing or malformed.
/// @param max_points  of the path, >= 2.
std::optional<FlownPath> read_path(const std::filesystem::path& flight_folder, uint64_t seed, size_t max_points);

/// The maps of flights. At most 24 scenes are generated. If the first eight seeds of a configuration give the same
/// scene, all its seeds are assumed to give it.
struct FlightMaps {
  std::vector<ScenePlan> plans;
  std::vector<std::optional<size_t>> map_of;  ///< of each flight: index in `plans`; none if the scene was not generated
};
FlightMaps flight_maps(const std::vector<std::optional<FlownPath>>& flights);

/// Returns the data for the page: `maps`, and for each flight `map` (-1 without a path or scene), `path` (north, east
/// in centimeters: the first point, then the steps from point to point) and `goal` [north, east, radius] in m or null.
nlohmann::ordered_json paths_data(const FlightMaps& maps, const std::vector<std::optional<FlownPath>>& flights);

}  // namespace hedgehop::sim
