#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "vision/camera/pinhole_camera.h"

namespace hedgehop::sim {

/// Distances in one level plane, as a planar laser scanner measures them. Frame Cl: origin of the camera, x along the
/// horizontal direction of its axis, y left, z up.
struct LevelScan {
  Eigen::Isometry3d X_ECl = Eigen::Isometry3d::Identity();
  double angle_min_rad = 0.0, angle_increment_rad = 0.0;  ///< from x towards y; the increment is > 0
  std::vector<float> ranges_m;  ///< +infinity beyond the maximum, NaN if unknown or out of the image
};

/// Returns the level slice of a depth image; nullopt if the camera's axis is less than 30 degrees from the vertical.
/// @param depth_m  CV_32FC1, z in C, m; NaN if unknown. @param X_EC  pose of the camera. @param max_m  maximum range.
std::optional<LevelScan> level_scan(const cv::Mat& depth_m, const vision::camera::PinholeCamera& lens,
                                    const Eigen::Isometry3d& X_EC, double max_m);

}  // namespace hedgehop::sim
