#pragma once

#include <Eigen/Geometry>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "scenes/scene.h"

namespace hedgehop::sim {

/// A solid seen from above.
struct Footprint {
  std::string name;
  std::vector<Eigen::Vector2d> corners_NE_m;  ///< convex outline, north and east
  double bottom_m = 0.0, top_m = 0.0;         ///< altitudes
};

/// The outline of each solid on the plan, of any attitude. Precise to a float's rounding of the coordinates; round ones
/// have 32 corners, a surface that of its convex hull.
std::vector<Footprint> footprints(const std::vector<scenes::Solid>& solids);

/// The path of a mover seen from above.
struct MoverPath {
  std::string name;
  std::vector<Eigen::Vector2d> corners_NE_m;  ///< of the path of M, in order; one when it stands still
  double radius_m = 0.0;                      ///< nothing of the mover is farther from M's origin, in the plan
};

/// Where each mover of a scene goes.
std::vector<MoverPath> mover_paths(const std::vector<scenes::Mover>& movers);

/// A scene as maps show it.
struct ScenePlan {
  std::vector<Footprint> footprints;
  std::vector<MoverPath> movers;
  Eigen::AlignedBox2d bounds_NE_m;
};
ScenePlan scene_plan(const scenes::Scene& scene);

/// Where a footprint lies for a flight between two altitudes: only what is beside it can be hit sideways.
enum class Level { below, beside, above };
/// @param margin_m  how far a solid may be off the flown band and still count as beside, >= 0.
Level level(const Footprint& footprint, double lowest_m, double highest_m, double margin_m);

/// What MapView (web/src/map.js) draws: `bounds` [north, north, east, east] or [], `footprints`, `movers`; places in m.
/// @param lowest_m, highest_m  altitudes between which was flown; they decide which solids are beside the flight.
nlohmann::ordered_json plan_data(const ScenePlan& plan, double lowest_m, double highest_m);

}  // namespace hedgehop::sim
