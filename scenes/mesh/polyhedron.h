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

/// Returns the image of a polyhedron under an affine map of positive determinant. It preserves convexity.
Polyhedron moved(const Eigen::Affine3d& map, const Polyhedron& polyhedron);

/// Returns an icosahedron of circumradius 1 whose faces are divided into four, `cuts` times. New corners are moved out
/// to radius 1. @param cuts  0..5.
Polyhedron ball(int cuts);

/// Returns the convex hull of points. Cost: the fourth power of their number.
/// @param points  at least four, in general position: no four points of the hull in a plane.
Polyhedron convex_hull(const std::vector<Eigen::Vector3d>& points);

/// Returns the k-th of `count` unit vectors that are spread evenly over the sphere: a spiral from pole to pole that
/// advances by the golden angle. @param first_rad  angle of the first one about the z axis.
Eigen::Vector3d spiral_direction(int k, int count, double first_rad);

/// Returns a convex lump around the origin: evenly spread corners at random distances within 1 - roughness .. 1.
/// @param points  4..64; the few that lie inside the hull are dropped. @param roughness  0..0.5.
Polyhedron convex_lump(int points, double roughness, Random& random);

}  // namespace hedgehop::scenes::mesh
