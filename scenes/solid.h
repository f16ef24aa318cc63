#pragma once

#include <Eigen/Geometry>
#include <string>

#include "scenes/mesh/polyhedron.h"

namespace hedgehop::scenes {

/// A body that can be hit, in its own frame S.
struct Solid {
  enum class Shape {
    box,       ///< faces at +-half_extents_m along the axes
    cylinder,  ///< upright, axis z: half extents (radius, radius, half height)
    sphere,    ///< half extents (radius, radius, radius)
    hull,      ///< `polyhedron`, closed and convex
    surface,   ///< the triangles of `polyhedron`, in any arrangement, without an inside
  };

  std::string name;
  Eigen::Isometry3d X_WS = Eigen::Isometry3d::Identity();
  Eigen::Vector3d half_extents_m = Eigen::Vector3d::Ones();  ///< > 0; the polyhedra do not need them
  Shape shape = Shape::box;
  mesh::Polyhedron polyhedron = {};  ///< in S, of hulls and surfaces only
};

/// Returns the smallest box along the axes of W that holds a solid (of a tilted cylinder: its enclosing box).
Eigen::AlignedBox3d bounds_W(const Solid& solid);

}  // namespace hedgehop::scenes
