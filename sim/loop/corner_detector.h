#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "sim/libm/random.h"
#include "vision/camera/camera.h"

namespace hedgehop::sim {

/// An ideal corner detector in a camera's place, made from the truth: positions of those known corners of the scene
/// that lie in the image, whatever stands before them, each with white noise. It is the front end of [Shah2009] ch. 4,
/// which has no images.
class CornerDetector {
 public:
  /// @param corners_W  m. @param noise_px  standard deviation per axis, >= 0. @param seed  of the noise's stream.
  CornerDetector(std::vector<Eigen::Vector3d> corners_W, double noise_px, uint64_t seed);

  /// Returns the frame of a camera. @param X_WC  its pose, true. Each call draws new noise.
  /// @return N x 1, CV_64FC2: (u, v), px, in the order of the corners; the noise may carry one over the image's edge.
  cv::Mat detect(const vision::camera::Camera& camera, const Eigen::Isometry3d& X_WC);

  /// Returns what it delivers when nothing is detected: 0 x 1, CV_64FC2.
  static cv::Mat nothing() { return cv::Mat(0, 1, CV_64FC2); }

 private:
  std::vector<Eigen::Vector3d> corners_W_;
  double noise_px_;
  RandomStream noise_;
};

}  // namespace hedgehop::sim
