#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "sim/pages/plan.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// A flight as a page of many draws it: its scene, and its path seen from above.
struct FlownPath {
  scenes::SceneConfig scene;
  uint64_t seed = 0;
  std::optional<GoalConfig> goal;
  std::vector<Eigen::Vector2d> p_NE_m;     ///< thinned out; empty without a row
  double lowest_m = 0.0, highest_m = 0.0;  ///< altitudes
};

/// Reads scenario.yaml and trajectory.csv of a flight's folder. Nothing when a file is missing or malformed.
/// @param max_points  of the path, >= 2.
std::optional<FlownPath> read_path(const std::filesystem::path& flight_folder, uint64_t seed, size_t max_points);

/// Which flights share a map. At most 24 scenes are generated again; where the first eight seeds of a configuration
/// give the same scene, its other seeds are assumed to give it too.
struct FlightMaps {
  std::vector<ScenePlan> plans;
  std::vector<std::optional<size_t>> map_of;  ///< one a flight: index into plans; none where the scene was not made
};
FlightMaps flight_maps(const std::vector<std::optional<FlownPath>>& flights);

/// What the page draws of them: `maps`, and for each flight `map` (-1 without a path or scene), `path` (north, east in
/// centimeters: the first point, then the steps from point to point) and `goal` [north, east, radius] in m or null.
nlohmann::ordered_json paths_data(const FlightMaps& maps, const std::vector<std::optional<FlownPath>>& flights);

}  // namespace hedgehop::sim
