#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "sim/fields/field.h"
#include "vision/corridor/corridor_flow.h"

namespace hedgehop::vision::corridor {

/// How the approach to what lies ahead is measured, and when the result is accepted; all of it is ours.
struct ApproachConfig {
  double half_width_rad = 20.0 * std::numbers::pi / 180.0;  ///< of the part of the view, to each side of the nose
  double sigma_per_s = 0.15;                                ///< greatest error of an accepted rate
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<ApproachConfig> auto& c) {
  v("half_width", c.half_width_rad,
    {.unit = "deg", .above = 0.0, .at_most = 60.0, .meaning = "half the width of the view ahead that is compared"});
  v("sigma", c.sigma_per_s,
    {.unit = "1/s", .above = 0.0, .meaning = "standard deviation of the approach rate above which it is rejected"});
}

/// How fast a wall ahead, perpendicular to the direction of travel, expands in the image. Measured from all its pixels:
/// a coarse texture seen from close range has few corners, but grey gradients everywhere.
struct ApproachRate {
  double rate_per_s = 0.0;   ///< speed over distance at the older image, half the flow's divergence
  double sigma_per_s = 0.0;  ///< standard deviation, from the residuals of the fit
};

class ApproachMeter {
 public:
  /// @param X_BC  pose of the camera in B. @param lowest_rad, highest_rad  elevations in B that count.
  /// @param rim_px  pixels this near to where the lens shows nothing stay out. Throws std::invalid_argument on a bad
  /// config.
  ApproachMeter(const ApproachConfig& config, const camera::Camera& camera, const Eigen::Isometry3d& X_BC,
                const CorridorRegions& regions, int rim_px);

  /// @param older, newer  CV_8UC1. @param motion  as of wall_point(), distance traveled not 0.
  /// @return nothing where the image has too little texture.
  std::optional<ApproachRate> measure(const cv::Mat& older, const cv::Mat& newer, const CameraMotion& motion) const;

 private:
  struct Sample {
    cv::Point pixel;
    Eigen::Vector3d ray_C;
  };
  struct Fit;
  std::optional<Fit> fit(const cv::Mat& older, const cv::Mat& newer, const CameraMotion& motion,
                         double rate_per_s) const;

  ApproachConfig config_;
  camera::Camera camera_;
  cv::Rect box_;  ///< holds all samples, with room to move
  std::vector<Sample> samples_;
};

}  // namespace hedgehop::vision::corridor
