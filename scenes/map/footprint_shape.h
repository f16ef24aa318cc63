#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scenes/map/building.h"

namespace hedgehop::scenes::map {

/// Returns a ring without corners that lie within 1 mm of the line between their neighbors. May be empty.
PlanRing simplified(const PlanRing& ring);

/// Returns whether a ring of positive area turns to one side only, so that a prism over it is convex.
bool is_convex(const PlanRing& ring);

/// Triangles that cover a footprint.
struct FootprintTriangles {
  std::vector<Eigen::Vector2d> corners;            ///< in the plan (north, east), m
  std::vector<std::array<uint32_t, 3>> triangles;  ///< of positive area, like the outer ring
};

/// Returns the triangles of a footprint. Each hole is connected to the outline by a bridge.
/// Source: after [Meisters1975]. Cost is quadratic in the number of corners.
FootprintTriangles triangles_of(const Footprint& footprint);

}  // namespace hedgehop::scenes::map
