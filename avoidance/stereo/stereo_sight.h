#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "avoidance/module.h"
#include "vision/stereo/disparity.h"
#include "vision/stereo/stereo_matcher.h"

namespace hedgehop::avoidance::stereo {

/// A pair of parallel cameras on board, and the disparity of what they see.
class StereoSight {
 public:
  /// Roles of the two cameras.
  static constexpr const char* kLeft = "left";
  static constexpr const char* kRight = "right";
  static Needs needs();

  /// Throws std::invalid_argument when the two cameras of the setup are not equal pinholes side by side (parallel axes,
  /// the right one displaced along the left one's x axis alone), or on a bad config of the matcher.
  StereoSight(const vision::stereo::StereoMatcherConfig& config, const Setup& setup);

  /// Takes in the frames of an observation. @return whether they hold a new pair, exposed at one instant.
  bool update(std::span<const CameraFrame> frames);

  int64_t t_ns() const { return t_ns_; }           ///< of the last pair; -1 before the first
  const cv::Mat& grey() const { return grey_; }    ///< CV_8UC1, the left image
  cv::Mat& disparity16() { return disparity16_; }  ///< of the left image, as in vision/disparity.h
  const vision::stereo::StereoGeometry& geometry() const { return geometry_; }
  const Eigen::Isometry3d& X_BC() const { return X_BC_; }  ///< pose of the left camera in B
  cv::Size image() const { return image_; }

 private:
  vision::stereo::StereoMatcher matcher_;
  vision::stereo::StereoGeometry geometry_;
  Eigen::Isometry3d X_BC_ = Eigen::Isometry3d::Identity();
  cv::Size image_;
  int64_t t_ns_ = -1;
  cv::Mat grey_, disparity16_;
};

}  // namespace hedgehop::avoidance::stereo
