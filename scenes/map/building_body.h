#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "scenes/map/building.h"
#include "scenes/mesh/polyhedron.h"

namespace hedgehop::scenes::map {

/// The shape of one footprint of a building. Points have the axes of W; their origin is `middle_NE` in the plan, at the
/// building's lowest point on the ground.
struct BuildingBody {
  using Triangle = std::array<Eigen::Vector3d, 3>;  ///< counter-clockwise seen from outside

  Eigen::Vector2d middle_NE = Eigen::Vector2d::Zero();
  std::vector<PlanRing> walls;          ///< outer ring and holes, relative to the middle; upright from bottom to eaves
  double eaves_m = 0.0;                 ///< height of the rectangular part of the walls
  std::vector<Triangle> roof;           ///< faces that are seen from above
  std::vector<Triangle> gables;         ///< upright faces above the eaves
  std::vector<Triangle> bottom;         ///< faces that are seen from below; empty on the ground
  std::vector<mesh::Polyhedron> hulls;  ///< convex bodies that fill the shape together
};

/// Returns the shape of a footprint. Gabled and hipped roofs need a convex outline of four corners, skillion and
/// pyramidal ones any convex outline; other outlines are drawn with a flat roof at the building's height.
/// @param[out] faults  receives a line if a roof is drawn flat, or if the footprint has no area.
BuildingBody body_of(const Footprint& footprint, const MapBuilding& building, std::vector<std::string>& faults);

}  // namespace hedgehop::scenes::map
