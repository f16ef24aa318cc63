#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace hedgehop::vision::landmarks {

/// Returns the pose of a camera that looks at a point, its image upright.
inline Eigen::Isometry3d looking_at(const Eigen::Vector3d& p_WC, const Eigen::Vector3d& target_W) {
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d forward = (target_W - p_WC).normalized();
  const Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(forward).normalized();
  X_WC.linear() << right, forward.cross(right), forward;
  X_WC.translation() = p_WC;
  return X_WC;
}

}  // namespace hedgehop::vision::landmarks
