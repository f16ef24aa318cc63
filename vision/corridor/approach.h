#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "sim/fields/field.h"
#include "vision/corridor/corridor_flow.h"

namespace hedgehop::vision::corridor {

/// How the approach to a wall ahead is measured, and when the result is accepted. Not from the paper.
struct ApproachConfig {
  double half_width_rad =
      20.0 * std::numbers::pi / 180.0;  ///< half width of the evaluated view, to each side of the nose
  double sigma_per_s = 0.15;            ///< maximum standard deviation of an accepted rate
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<ApproachConfig> auto& c) {
  v("half_width", c.half_width_rad,
    {.unit = "deg", .above = 0.0, .at_most = 60.0, .meaning = "half the width of the evaluated view ahead"});
  v("sigma", c.sigma_per_s,
    {.unit = "1/s", .above = 0.0, .meaning = "standard deviation of the approach rate above which it is rejected"});
}

/// Rate at which a wall ahead, perpendicular to the direction of travel, expands in the image. It is measured from all
/// pixels, because a coarse texture at close range has few corners but gradients everywhere.
struct ApproachRate {
  double rate_per_s = 0.0;   ///< speed over distance at the older image, half the flow's divergence
  double sigma_per_s = 0.0;  ///< standard deviation, from the residuals of the fit
};

/// Measures the approach rate from pairs of images.
class ApproachMeter {
 public:
  /// @param X_BC  pose of the camera in B. @param regions  gives the range of elevations. @param rim_px  pixels this
  /// close to the border of the image or of the lens's image circle are ignored. Throws std::invalid_argument on an
  /// invalid config.
  ApproachMeter(const ApproachConfig& config, const camera::Camera& camera, const Eigen::Isometry3d& X_BC,
                const CorridorRegions& regions, int rim_px);

  /// Returns the approach rate; std::nullopt if the image has too little texture.
  /// @param older, newer  CV_8UC1. @param motion  as for wall_point(), with a distance traveled > 0.
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
  cv::Rect box_;  ///< contains all samples, with a margin for their displacement
  std::vector<Sample> samples_;
};

}  // namespace hedgehop::vision::corridor
