#pragma once

#include <span>
#include <string>
#include <vector>

#include "dynamics/sensors/imu.h"
#include "sim/scenario/rig.h"

namespace hedgehop::sim {

// Cameras for other programs, every number exact. Pixel (0, 0) is the center of the top-left pixel in all formats, and
// the camera frame C is ours: right, down, forward. The functions throw std::invalid_argument, naming the camera, for a
// lens that the format cannot describe, and as CameraConfig::model().

/// Rotation from B to F, the IMU frame in all files for other programs: forward, left, up, with its origin at the IMU.
inline Eigen::Matrix3d R_FB() { return Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal(); }

/// Returns the pose of B in F.
Eigen::Isometry3d X_FB(const dynamics::sensors::ImuConfig& imu);
/// Returns the pose of a camera in F. @param X_BC  its pose in B.
Eigen::Isometry3d X_FC(const dynamics::sensors::ImuConfig& imu, const Eigen::Isometry3d& X_BC);
/// Returns the calibrated pose of a camera in F; that of its calibration file without rounding.
Eigen::Isometry3d X_FC(const dynamics::sensors::ImuConfig& imu, const CameraConfig& camera);

/// A lens as other programs describe it.
struct Intrinsics {
  enum class Model { pinhole, fisheye, unified, double_sphere };
  Model model = Model::pinhole;
  double focal_x_px = 0.0, focal_y_px = 0.0, center_u_px = 0.0, center_v_px = 0.0;
  std::vector<double> distortion;  ///< k1 k2 p1 p2 k3, with k4 k5 k6 if rational; k1 k2 k3 k4 of a fisheye; k1 k2 p1 p2
  double xi = 0.0, alpha = 0.0;    ///< of a unified and a double-sphere lens
};
Intrinsics intrinsics(const CameraConfig& config, const vision::camera::Camera& camera);

/// A file of OpenCV's FileStorage: a map for each role with image_width, image_height, camera_model ("pinhole" for
/// calib3d, "fisheye" and "omnidir" for its modules), camera_matrix, xi of omnidir, distortion_coefficients
/// and the poses imu_from_camera (X_FC, 4 x 4) and body_from_camera (X_BC, 4 x 4).
std::string opencv_calibration(std::span<const CameraConfig> cameras, const dynamics::sensors::ImuConfig& imu);

/// A camera chain of Kalibr: cam0, cam1, ... in the given order, T_cam_imu (X_CF), and T_cn_cnm1 (from the camera
/// before). It has neither k3 nor the rational model. @param opencv_header  whether the file begins with the line that
/// OpenCV's FileStorage needs and PyYAML, the reader of Kalibr, refuses.
std::string kalibr_calibration(std::span<const CameraConfig> cameras, const dynamics::sensors::ImuConfig& imu,
                               bool opencv_header = false);

}  // namespace hedgehop::sim
