#pragma once

#include <Eigen/Core>
#include <vector>

namespace hedgehop::dynamics {

/// A convex piece of a vehicle's hull, for collisions and clearances.
struct HullPart {
  enum class Shape { cylinder, box };
  Shape shape = Shape::box;
  Eigen::Vector3d center_B_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d half_extents_m = Eigen::Vector3d::Ones();  ///< > 0; a cylinder's axis is B's z: (r, r, half height)
};

/// Returns the radius of the smallest vertical cylinder around B, level, that holds the hull, m; 0 for an empty hull.
double radius_m(const std::vector<HullPart>& hull);

}  // namespace hedgehop::dynamics
