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

/// Vectors without which a side is unknown: fewer do not outvote their outliers in a median.
inline constexpr int kMinVectors = 12;

/// What two images of a fisheye show of a corridor.
struct WallObservation {
  std::vector<vision::corridor::WallPoint> points;
  double direction_rad = 0.0;                     ///< of the walls, to the right of the heading; 0 as printed
  vision::corridor::SideDistance left, right;     ///< medians of the sides, across that direction
  double error = 0.0;                             ///< e_n, NaN when a side is unknown
  int corners_left = 0, corners_right = 0;        ///< tracked at the sides, whatever their flow
  Eigen::Vector2d v_H = Eigen::Vector2d::Zero();  ///< mean horizontal velocity between the images, m/s
  std::optional<vision::corridor::ApproachRate>
      approach;  ///< of what lies ahead; nothing when it has too little texture
};

/// Measures a corridor's walls by the flow of a fisheye that looks down.
/// Source: [Zingg2010] sec. IV. With Law::modified also: the newer image is derotated before corners are tracked,
/// distances are measured across the walls and not the heading, tracking is checked backwards, flow that fits no fixed
/// point is rejected, a side with too many slow vectors is unknown, and the approach to what lies ahead is measured.
class WallObserver {
 public:
  static constexpr const char* kRole = "fisheye";

  /// @param attitude_lag_s  of the attitude estimate, >= 0. @param camera  looks down or so; any lens.
  WallObserver(Law law, double attitude_lag_s, const MountedCamera& camera);

  /// Reads an image. @return what it shows together with the one before; nothing for the first.
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
