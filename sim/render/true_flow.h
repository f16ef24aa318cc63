#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "vision/camera/camera.h"

namespace hedgehop::sim {

/// Returns the unit ray of each pixel in C, row-major; NaN outside the image circle.
std::vector<Eigen::Vector3d> all_rays(const vision::camera::Camera& camera);

/// Depth and labels of an image, its pose, and the pose of the next image.
struct FlowInput {
  const cv::Mat& depth;   ///< as ImageChannel::depth, of `camera`
  const cv::Mat& labels;  ///< as ImageChannel::labels; not read if no obstacle moves
  Eigen::Isometry3d X_WC, X_WC_next;
  int first_mover_label = 0;  ///< first label of a moving obstacle
  /// Motion of each moving obstacle until the next image: maps its points in W.
  std::span<const Eigen::Isometry3d> moved_W;
};

/// Returns the displacement of a point. It is exactly the translation if the motion does not rotate.
Eigen::Vector3d displacement(const Eigen::Isometry3d& moved_W, const Eigen::Vector3d& p_W);

/// Computes the displacement of the point of each pixel until the next image. Sky is at infinity.
/// @param rays  all_rays() of the camera.
/// @param out   CV_32FC2, right and down, px; NaN if the point is outside the image circle in either image.
void true_flow(const vision::camera::Camera& camera, const std::vector<Eigen::Vector3d>& rays, const FlowInput& input,
               cv::Mat& out);
/// The same for an undistorted pinhole, several times faster.
void true_flow(const vision::camera::PinholeCamera& camera, const FlowInput& input, cv::Mat& out);

}  // namespace hedgehop::sim
