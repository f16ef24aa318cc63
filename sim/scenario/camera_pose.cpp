#include "sim/scenario/camera_pose.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>

#include "sim/fields/invalid_field.h"
#include "sim/scenario/calibration.h"

namespace hedgehop::sim {
namespace {

using fields::require;

/// Returns the rotation nearest to a matrix that is one within the digits of a file; unchanged if it is exact.
Eigen::Matrix3d rotation(const Eigen::Matrix3d& R, std::string_view key) {
  constexpr double kRounded = 1e-12, kMaxError = 1e-3;
  const double error = (R.transpose() * R - Eigen::Matrix3d::Identity()).norm();
  require(error <= kMaxError && R.determinant() > 0.0, key, "its first three columns and rows are no rotation");
  return error <= kRounded ? R : Eigen::Quaterniond(R).normalized().toRotationMatrix();
}

/// Return the first key of the position or of the angles that is not 0, or "".
std::string_view position_key(const CameraConfig& c) {
  return c.forward_m != 0.0 ? "forward" : c.right_m != 0.0 ? "right" : c.down_m != 0.0 ? "down" : "";
}
std::string_view angle_key(const CameraConfig& c) {
  return c.yaw_rad != 0.0 ? "yaw" : c.pitch_rad != 0.0 ? "pitch" : c.roll_rad != 0.0 ? "roll" : "";
}

/// Refuses a pose that is stated twice.
void require_one_pose(const CameraConfig& c) {
  std::string_view first;
  const auto state = [&](std::string_view key, bool is_stated) {
    if (!is_stated) return;
    require(first.empty(), key,
            fmt::format("'{}' states the pose already; valid: one matrix, or a position with a quaternion or with yaw, "
                        "pitch and roll",
                        first));
    first = key;
  };
  state("body_from_camera", !c.body_from_camera.empty());
  state("imu_from_camera", !c.imu_from_camera.empty());
  state("camera_from_imu", !c.camera_from_imu.empty());
  if (!first.empty()) state(position_key(c), !position_key(c).empty());
  state("quaternion", !c.quaternion.empty());
  state(angle_key(c), !angle_key(c).empty());
}

}  // namespace

Eigen::Isometry3d pose_of(const std::vector<double>& numbers, std::string_view key) {
  require(numbers.size() == 16, key, fmt::format("must have 16 numbers, got {}", numbers.size()));
  const Eigen::Matrix4d matrix = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
  require(matrix.row(3) == Eigen::RowVector4d(0, 0, 0, 1), key, "its last row must be 0 0 0 1");
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = rotation(matrix.topLeftCorner<3, 3>(), key);
  X.translation() = matrix.topRightCorner<3, 1>();
  return X;
}

void clear_matrices(CameraConfig& c) {
  for (std::vector<double>* matrix : {&c.body_from_camera, &c.imu_from_camera, &c.camera_from_imu}) matrix->clear();
}

std::vector<double> numbers_of(const Eigen::Isometry3d& X) {
  std::vector<double> numbers;
  for (const auto& row : X.matrix().rowwise()) numbers.insert(numbers.end(), row.begin(), row.end());
  return numbers;
}

bool has_matrix(const CameraConfig& c) {
  return !c.body_from_camera.empty() || !c.imu_from_camera.empty() || !c.camera_from_imu.empty() ||
         !c.camera_from_previous.empty();
}

bool has_mounting(const CameraConfig& c) {
  return !position_key(c).empty() || !angle_key(c).empty() || !c.quaternion.empty();
}

Eigen::Isometry3d CameraConfig::X_BC() const {
  require_one_pose(*this);
  dynamics::sensors::ImuConfig imu{.p_BI_m = p_BI_m};
  const auto from_F = [&](const Eigen::Isometry3d& X_FC) { return X_FB(imu).inverse() * X_FC; };
  if (!body_from_camera.empty()) return pose_of(body_from_camera, "body_from_camera");
  if (!imu_from_camera.empty()) return from_F(pose_of(imu_from_camera, "imu_from_camera"));
  if (!camera_from_imu.empty()) return from_F(pose_of(camera_from_imu, "camera_from_imu").inverse());
  Eigen::Isometry3d X_BC = Eigen::Isometry3d::Identity();
  X_BC.translation() = Eigen::Vector3d(forward_m, right_m, down_m);
  if (!quaternion.empty()) {
    require(quaternion.size() == 4, "quaternion", fmt::format("must have 4 numbers, got {}", quaternion.size()));
    const Eigen::Quaterniond q_BC(quaternion[0], quaternion[1], quaternion[2], quaternion[3]);
    constexpr double kMaxError = 1e-3;
    require(std::abs(q_BC.norm() - 1.0) <= kMaxError, "quaternion", "must have length 1");
    X_BC.linear() = q_BC.normalized().toRotationMatrix();
    return X_BC;
  }
  // Columns are C's axes (right, down, forward) of a forward camera, expressed in B: a cyclic permutation.
  Eigen::Matrix3d R_forward;
  R_forward.col(0) = Eigen::Vector3d::UnitY();
  R_forward.col(1) = Eigen::Vector3d::UnitZ();
  R_forward.col(2) = Eigen::Vector3d::UnitX();

  const Eigen::Quaterniond q_mount = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
                                     Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
                                     Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX());
  X_BC.linear() = q_mount.toRotationMatrix() * R_forward;
  return X_BC;
}

}  // namespace hedgehop::sim
