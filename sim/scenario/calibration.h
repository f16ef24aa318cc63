#pragma once

#include <string>
#include <vector>

#include "sim/scenario/rig.h"

namespace hedgehop::sim {

// The cameras of a rig for other programs, every number exact. Pixel (0, 0) is the center of the top-left pixel in both
// formats, and the camera frame is ours: right, down, forward. The body is forward, right, down. Throw
// std::invalid_argument, naming the camera, for a lens that the format cannot describe, and as CameraConfig::model().

/// A lens as other programs describe it.
struct Intrinsics {
  bool fisheye = false;
  double focal_x_px = 0.0, focal_y_px = 0.0, center_u_px = 0.0, center_v_px = 0.0;
  std::vector<double> distortion;  ///< k1 k2 p1 p2 k3, or k1 k2 k3 k4 of a fisheye
};
Intrinsics intrinsics(const CameraConfig& config, const vision::camera::Camera& camera);

/// A file of OpenCV's FileStorage: a map for each role with image_width, image_height, camera_model ("pinhole" for
/// calib3d, "fisheye" for its fisheye module), camera_matrix, distortion_coefficients (k1 k2 p1 p2 k3 or k1 k2 k3 k4)
/// and body_from_camera (X_BC, 4 x 4).
std::string opencv_calibration(const RigConfig& rig);

/// A camera chain of Kalibr: cam0, cam1, ... in the rig's order, T_cam_imu (X_CB, for an IMU at B's origin along B's
/// axes), and T_cn_cnm1 (from the camera before). It has no k3.
std::string kalibr_calibration(const RigConfig& rig);

}  // namespace hedgehop::sim
