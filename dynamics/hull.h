#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

namespace hedgehop::dynamics {

/// Convex part of a vehicle's hull, for collisions and clearances.
struct HullPart {
  enum class Shape { cylinder, box };
  Shape shape = Shape::box;
  Eigen::Vector3d center_B_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d half_extents_m = Eigen::Vector3d::Ones();  ///< > 0; a cylinder's axis is B's z: (r, r, half height)
};

/// Returns the radius of the smallest cylinder about B's z axis that holds the hull, m; 0 for an empty hull.
inline double radius_m(const std::vector<HullPart>& hull) {
  double radius = 0.0;
  for (const HullPart& part : hull) {
    const Eigen::Vector2d center = part.center_B_m.head<2>();
    const double reach = part.shape == HullPart::Shape::cylinder
                             ? center.norm() + part.half_extents_m.x()
                             : (center.cwiseAbs() + part.half_extents_m.head<2>()).norm();
    radius = std::max(radius, reach);
  }
  return radius;
}

}  // namespace hedgehop::dynamics
