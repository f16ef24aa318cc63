#pragma once

#include <Eigen/Geometry>

/// The one place that converts to other programs' frames. E: east, north, up, fixed at W's origin. F: forward, left,
/// up, fixed to the vehicle. Cameras' own axes stay as they are: right, down, forward.
namespace hedgehop::sim {

inline Eigen::Matrix3d R_EW() {
  Eigen::Matrix3d R;
  R << 0, 1, 0,  //
      1, 0, 0,   //
      0, 0, -1;
  return R;
}

inline Eigen::Matrix3d R_FB() { return Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal(); }

/// Pose of F in E for a frame along B's axes; both have the same origin.
inline Eigen::Isometry3d X_EF(const Eigen::Isometry3d& X_WB) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = R_EW() * X_WB.linear() * R_FB().transpose();
  X.translation() = R_EW() * X_WB.translation();
  return X;
}

}  // namespace hedgehop::sim
