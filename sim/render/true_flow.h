#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "vision/camera/camera.h"

namespace hedgehop::sim {

/// The ray of every pixel, in C, row by row; NaN where the lens shows nothing.
std::vector<Eigen::Vector3d> all_rays(const vision::camera::Camera& camera);

/// What an image shows, and the pose and time of the next one.
struct FlowInput {
  const cv::Mat& depth;   ///< as Channel::depth, of `camera`
  const cv::Mat& labels;  ///< as Channel::labels; not read without movers
  Eigen::Isometry3d X_WC, X_WC_next;
  int first_mover_label = 0;                   ///< labels from here on are movers
  std::span<const Eigen::Vector3d> moved_W_m;  ///< displacement of each mover until then
};

/// Motion of each pixel's point in the image. @param rays  all_rays() of the camera.
/// @param out  CV_32FC2, right and down, px; NaN where the lens shows nothing, now or then. Sky is infinitely far away.
void true_flow(const vision::camera::Camera& camera, const std::vector<Eigen::Vector3d>& rays, const FlowInput& input,
               cv::Mat& out);
/// The same of an undistorted pinhole, several times faster.
void true_flow(const vision::camera::PinholeCamera& camera, const FlowInput& input, cv::Mat& out);

}  // namespace hedgehop::sim
