#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "avoidance/law.h"
#include "avoidance/module.h"
#include "vision/camera/image_derotator.h"
#include "vision/corridor/approach.h"
#include "vision/corridor/corridor_flow.h"

namespace hedgehop::avoidance::corridor_centering {

/// Minimum number of vectors for a known side. With fewer vectors a median does not reject outliers.
inline constexpr int kMinVectors = 12;

/// Measurements of a corridor from two fisheye images.
struct WallObservation {
  std::vector<vision::corridor::WallPoint> points;
  double direction_rad = 0.0;  ///< direction of the walls, to the right of the heading; 0 with the published law
  vision::corridor::SideDistance left, right;     ///< medians of the sides, across that direction
  double error = 0.0;                             ///< e_n, NaN if a side is unknown
  int corners_left = 0, corners_right = 0;        ///< tracked on each side, with any flow
  Eigen::Vector2d v_H = Eigen::Vector2d::Zero();  ///< mean horizontal velocity between the images, m/s
  /// Approach to the obstacle ahead; empty if the texture is insufficient.
  std::optional<vision::corridor::ApproachRate> approach;
};

/// Measures the walls of a corridor with the flow of a fisheye that looks down. Source: [Zingg2010] sec. IV. Additions
/// of Law::modified: the newer image is derotated before corners are tracked; distances are measured across the walls
/// instead of the heading; tracking is verified backwards; flow that fits no fixed point is rejected; a side with too
/// many slow vectors is unknown; the approach to the obstacle ahead is measured.
class WallObserver {
 public:
  static constexpr const char* kRole = "fisheye";

  /// @param attitude_lag_s  of the attitude estimate, >= 0. @param camera  looks approximately down; any lens.
  WallObserver(Law law, double attitude_lag_s, const MountedCamera& camera);

  /// Reads an image. @return measurements from this and the previous image; empty for the first image.
  std::optional<WallObservation> update(const CameraFrame& frame, const NavigationState& navigation);

  const cv::Mat& image() const { return image_; }  ///< CV_8UC1, the last
  const std::array<cv::Mat, vision::corridor::kRegions>& regions() const { return regions_; }

 private:
  WallObservation compare(const cv::Mat& older, const NavigationState& navigation, double dt_s) const;
  vision::corridor::CameraMotion motion(const NavigationState& now, double dt_s) const;
  vision::corridor::SideDistance side(const std::vector<vision::corridor::WallPoint>& points,
                                      vision::corridor::Region side) const;

  Law law_;
  double attitude_lag_s_;
  MountedCamera camera_;
  vision::flow::FeatureFlowConfig features_;
  vision::corridor::FlowLimits limits_;
  std::array<cv::Mat, vision::corridor::kRegions> regions_;
  vision::camera::ImageDerotator derotator_;
  vision::corridor::ApproachMeter approach_;
  cv::Mat image_;
  int64_t t_ns_ = -1;
  NavigationState navigation_;  ///< at the last image, without the lag
};

}  // namespace hedgehop::avoidance::corridor_centering
