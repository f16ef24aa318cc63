#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "avoidance/module.h"
#include "vision/stereo/disparity.h"
#include "vision/stereo/stereo_matcher.h"

namespace hedgehop::avoidance::stereo {

/// Disparity of what lies ahead: from a pair of parallel cameras, or from one camera that measures depth.
class DisparitySource {
 public:
  enum class From {
    stereo,  ///< cameras `left` and `right`, matched
    camera,  ///< camera `depth`; its depth becomes the disparity of a pair with kBaselineM
  };
  enum class Grey { needed, unused };  ///< of a depth camera: whether a camera `left` gives its grey image

  static constexpr const char* kLeft = "left";
  static constexpr const char* kRight = "right";
  static constexpr const char* kDepth = "depth";
  static constexpr double kBaselineM = 0.3;  ///< of the pair that a depth camera stands for: [Andert2007] sec. 2

  /// @param pair  before the roles, as in "aft_left"; empty for the first pair, or depth camera.
  static Needs needs(From from, Grey grey, const std::string& pair = "");

  /// Throws std::invalid_argument when the cameras of the setup do not fit together: a pair needs equal pinholes with
  /// parallel axes, the right one displaced along the left one's x axis alone; `left` beside a depth camera needs its
  /// lens and pose. Also on a bad config of the matcher.
  DisparitySource(From from, Grey grey, const vision::stereo::StereoMatcherConfig& config, const Setup& setup,
                  const std::string& pair = "");

  /// Reads the frames of an observation. @return whether they hold new images, all exposed at one instant.
  bool update(std::span<const CameraFrame> frames);

  const cv::Mat& grey() const { return grey_; }    ///< CV_8UC1, the left image; empty where unused
  cv::Mat& disparity16() { return disparity16_; }  ///< of the left image, as in vision/stereo/disparity.h
  const cv::Mat& disparity16() const { return disparity16_; }
  /// CV_32FC1, z in C, m, as a depth camera measured it; empty of a pair.
  const cv::Mat& depth_m() const { return depth_m_; }
  const vision::stereo::StereoGeometry& geometry() const { return geometry_; }
  const Eigen::Isometry3d& X_BC() const { return X_BC_; }  ///< pose of the left or depth camera in B
  cv::Size image() const { return image_; }

 private:
  bool match(std::span<const CameraFrame> frames);
  bool convert(std::span<const CameraFrame> frames);

  From from_;
  Grey grey_use_;
  std::string left_, right_, depth_;  ///< roles
  vision::stereo::StereoMatcher matcher_;
  vision::stereo::StereoGeometry geometry_;
  Eigen::Isometry3d X_BC_ = Eigen::Isometry3d::Identity();
  cv::Size image_;
  int64_t t_ns_ = -1;  ///< of the last images
  cv::Mat grey_, disparity16_, depth_m_;
};

}  // namespace hedgehop::avoidance::stereo
