#pragma once

#include <Eigen/Geometry>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "scenes/scene.h"

namespace hedgehop::sim {

/// A solid in plan view.
struct SolidOutline {
  std::string name;
  std::vector<Eigen::Vector2d> corners_NE_m;  ///< convex outline, north and east
  double bottom_m = 0.0, top_m = 0.0;         ///< altitudes
};

/// Returns the outline of each solid, of any attitude. Coordinates are rounded to float. Round solids have 32 corners;
/// the outline of a surface is its convex hull.
std::vector<SolidOutline> solid_outlines(const std::vector<scenes::Solid>& solids);

/// The path of a moving obstacle in plan view.
struct MoverPath {
  std::string name;
  std::vector<Eigen::Vector2d> corners_NE_m;  ///< of the path of M, in order; one corner if it does not move
  double radius_m = 0.0;                      ///< maximum horizontal distance of its surface from the origin of M
};

/// Returns the path of each moving obstacle.
std::vector<MoverPath> mover_paths(const std::vector<scenes::Mover>& movers);

/// A scene on a map.
struct ScenePlan {
  std::vector<SolidOutline> outlines;
  std::vector<MoverPath> movers;
  Eigen::AlignedBox2d bounds_NE_m;
};
ScenePlan scene_plan(const scenes::Scene& scene);

/// Position of a solid relative to the altitudes of a flight. A level flight can collide only with solids at its
/// altitude.
enum class AltitudeRelation { below, at_altitude, above };
/// @param margin_m  maximum vertical distance of a solid at flight altitude from the flown altitudes, >= 0.
AltitudeRelation altitude_relation(const SolidOutline& outline, double lowest_m, double highest_m, double margin_m);

/// Returns the data for MapView (web/src/map.js): `bounds` [north, north, east, east] or [], `footprints`, `movers`; in
/// m.
/// @param lowest_m, highest_m  minimum and maximum altitude of the flight, for the altitude relation of the solids.
nlohmann::ordered_json plan_data(const ScenePlan& plan, double lowest_m, double highest_m);

}  // namespace hedgehop::sim
