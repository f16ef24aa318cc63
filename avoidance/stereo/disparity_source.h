#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "avoidance/module.h"
#include "avoidance/stereo/motion_depth.h"
#include "vision/stereo/disparity.h"
#include "vision/stereo/stereo_matcher.h"

namespace hedgehop::avoidance::stereo {

/// Disparity from a pair of parallel cameras, from one depth camera, or from one camera and its motion.
class DisparitySource {
 public:
  enum class From {
    stereo,  ///< cameras `left` and `right`, matched
    camera,  ///< camera `depth`; its depth is converted to the disparity of a pair with the baseline kBaselineM
    motion,  ///< camera `front` and its own motion, converted likewise
  };
  enum class Grey { needed, unused };  ///< whether camera `left` gives the grey image of a depth camera

  static constexpr const char* kLeft = "left";
  static constexpr const char* kRight = "right";
  static constexpr const char* kDepth = "depth";
  static constexpr const char* kFront = "front";
  static constexpr double kBaselineM = 0.3;  ///< baseline of the pair that one camera replaces: [Andert2007] sec. 2

  /// @param pair  prefix of the roles, as in "aft_left"; empty for the first pair or depth camera.
  static Needs needs(From from, Grey grey, const std::string& pair = "");

  /// Throws std::invalid_argument on a bad config of the matcher, or if the cameras of the setup do not fit together.
  /// The cameras of a pair must be equal pinholes with parallel axes, the right one displaced along the x axis of the
  /// left one only. `left` next to a depth camera must have the lens and pose of the depth camera.
  DisparitySource(From from, Grey grey, const vision::stereo::StereoMatcherConfig& config, const Setup& setup,
                  const std::string& pair = "");

  /// Reads the frames of an observation. @param navigation  at its time; used only with From::motion.
  /// @return whether they contain new images that were all exposed at one instant.
  bool update(std::span<const CameraFrame> frames, const NavigationState& navigation = {});

  const cv::Mat& grey() const { return grey_; }         ///< CV_8UC1, the left image; empty if unused
  const cv::Mat& right() const { return right_grey_; }  ///< CV_8UC1, the right image of a pair; otherwise empty
  cv::Mat& disparity16() { return disparity16_; }       ///< of the left image, as in vision/stereo/disparity.h
  const cv::Mat& disparity16() const { return disparity16_; }
  /// CV_16SC1, 1-sigma error of the disparity x 16 at matched pixels; empty if it is not known pixel by pixel.
  const cv::Mat& sigma16() const { return sigma16_; }
  /// CV_32FC1, z in C, m, as measured by a depth camera; empty for a pair.
  const cv::Mat& depth_m() const { return depth_m_; }
  const vision::stereo::StereoGeometry& geometry() const { return geometry_; }
  const Eigen::Isometry3d& X_BC() const { return X_BC_; }  ///< pose of the left or depth camera in B
  cv::Size image() const { return image_; }

 private:
  bool match(std::span<const CameraFrame> frames);
  bool convert(std::span<const CameraFrame> frames);
  bool compare(std::span<const CameraFrame> frames, const NavigationState& navigation);

  From from_;
  Grey grey_use_;
  std::string left_, right_, depth_, front_;  ///< roles
  vision::stereo::StereoMatcher matcher_;
  vision::stereo::StereoGeometry geometry_;
  Eigen::Isometry3d X_BC_ = Eigen::Isometry3d::Identity();
  cv::Size image_;
  int64_t t_ns_ = -1;  ///< of the last images
  cv::Mat grey_, right_grey_, disparity16_, sigma16_, depth_m_;
  std::optional<MotionDepth> motion_;
};

}  // namespace hedgehop::avoidance::stereo
