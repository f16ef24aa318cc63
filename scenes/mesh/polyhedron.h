#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "sim/libm/random.h"

namespace hedgehop::scenes::mesh {

/// Corners and triangular faces, counter-clockwise seen from outside.
struct Polyhedron {
  std::vector<Eigen::Vector3d> corners;  ///< m
  std::vector<std::array<uint32_t, 3>> faces;
};

/// Returns the polyhedron with each corner moved by an affine map of positive determinant: convex ones stay convex.
Polyhedron moved(const Eigen::Affine3d& map, const Polyhedron& polyhedron);

/// Returns an icosahedron of circumradius 1, each face cut in four `cuts` times and its corners pushed out to radius 1.
/// @param cuts  0..5.
Polyhedron ball(int cuts);

/// Returns the convex hull of points, those inside it left out.
/// @param points  at least four, in general position: no four hull points in a plane. Cost: their number to the fourth.
Polyhedron convex_hull(const std::vector<Eigen::Vector3d>& points);

/// Returns a convex lump round the origin: corners spread evenly, at random distances within 1 - roughness .. 1.
/// @param points  4..64; few of them may end up inside and be left out. @param roughness  0..0.5.
Polyhedron convex_lump(int points, double roughness, Random& random);

}  // namespace hedgehop::scenes::mesh
