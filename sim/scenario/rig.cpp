#include "sim/scenario/rig.h"

namespace hedgehop::sim {

Eigen::Isometry3d CameraConfig::X_BC() const {
  // Columns are C's axes (right, down, forward) of a forward camera, expressed in B: a cyclic permutation.
  Eigen::Matrix3d R_forward;
  R_forward.col(0) = Eigen::Vector3d::UnitY();
  R_forward.col(1) = Eigen::Vector3d::UnitZ();
  R_forward.col(2) = Eigen::Vector3d::UnitX();

  const Eigen::Quaterniond q_mount = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
                                     Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
                                     Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX());
  Eigen::Isometry3d X_BC = Eigen::Isometry3d::Identity();
  X_BC.linear() = q_mount.toRotationMatrix() * R_forward;
  X_BC.translation() = Eigen::Vector3d(forward_m, right_m, down_m);
  return X_BC;
}

vision::PinholeCamera CameraConfig::model() const {
  return vision::PinholeCamera::from_fov(width_px, height_px, fov_rad);
}

const CameraConfig* RigConfig::find(std::string_view role) const {
  for (const CameraConfig& camera : cameras) {
    if (camera.role == role) return &camera;
  }
  return nullptr;
}

}  // namespace hedgehop::sim
