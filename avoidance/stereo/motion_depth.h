#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <opencv2/core.hpp>
#include <optional>

#include "avoidance/module.h"
#include "vision/motion/plane_sweep.h"

namespace hedgehop::avoidance::stereo {

/// Depth from one camera and its own motion: each image is compared with a key image, taken a baseline before. The
/// baseline follows the nearest surface: a long one makes depth accurate, but the nearest surfaces leave the images.
/// The motion is integrated from the estimated velocity in B and the gyros, because the drift of the position and the
/// corrections of the attitude would displace the focus of expansion.
class MotionDepth {
 public:
  static constexpr double kLongestM = 2.0;  ///< maximum baseline

  /// Throws std::invalid_argument if the camera does not suit (vision/motion/plane_sweep.h).
  explicit MotionDepth(const MountedCamera& camera);

  /// Adds an image. @param grey  CV_8UC1, of the camera's size. @param t_s  time of the image, increasing.
  /// @return its depth; all NaN if the camera has not moved far enough.
  vision::motion::InverseDepth update(const cv::Mat& grey, const NavigationState& navigation, double t_s);

  double baseline_m() const { return baseline_m_; }  ///< of the last image; 0 if it has no depth

 private:
  struct KeyImage {
    cv::Mat smooth;
    Eigen::Isometry3d X_WgC;  ///< pose; Wg is W at the start and drifts with the gyros
    double t_s;
  };
  void move(const NavigationState& navigation, double t_s);
  const KeyImage* choose_key(const Eigen::Isometry3d& X_WgC) const;
  void adapt_baseline(const cv::Mat& per_m);

  Eigen::Isometry3d X_BC_;
  vision::motion::PlaneSweep sweep_;
  Eigen::Vector3d p_WgB_ = Eigen::Vector3d::Zero(), v_WB_Wg_ = Eigen::Vector3d::Zero();
  std::optional<double> moved_s_;
  std::deque<KeyImage> keys_;  ///< oldest first
  double wanted_m_ = 0.0, baseline_m_ = 0.0;
};

}  // namespace hedgehop::avoidance::stereo
