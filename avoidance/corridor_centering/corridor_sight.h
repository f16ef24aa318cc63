#pragma once

#include <array>
#include <cstdint>
#include <numbers>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "avoidance/module.h"
#include "vision/camera/image_derotator.h"
#include "vision/corridor/approach.h"
#include "vision/corridor/corridor_flow.h"

namespace hedgehop::avoidance::corridor_centering {

/// What a fisheye that looks down tells of a corridor, image by image.
struct CorridorView {
  std::vector<vision::corridor::WallPoint> points;
  double direction_rad = 0.0;                          ///< of the walls, to the right of the heading; 0 as printed
  vision::corridor::SideDistance left, right;          ///< medians of the sides, across that direction
  double error = 0.0;                                  ///< e_n, NaN when a side is unknown
  int corners_left = 0, corners_right = 0;             ///< followed at the sides, whatever their flow
  Eigen::Vector2d v_H = Eigen::Vector2d::Zero();       ///< mean horizontal velocity between the images, m/s
  std::optional<vision::corridor::Approach> approach;  ///< of what lies ahead; nothing when too little is seen of it
};

struct CorridorSightConfig {
  /// `rays` is the paper's; `image` turns the newer image back before corners are followed.
  enum class Derotation { rays, image };
  Derotation derotation = Derotation::image;
  /// `heading` is the paper's; `walls` does not take a nose turned aside for an offset.
  enum class Across { heading, walls };
  Across across = Across::walls;
  vision::flow::FeatureFlowConfig features;
  vision::corridor::CorridorRegions regions;
  vision::corridor::FlowLimits limits;
  vision::corridor::ApproachConfig approach;
  int least_vectors = 12;
  double most_slow = 0.5;
  double most_turned_rad = 50.0 * std::numbers::pi / 180.0;
  double attitude_lag_s = 0.0032;  ///< of a first-order filter of 50 Hz on the gyros
};

template <class Visitor>
void describe(Visitor& v, CorridorSightConfig& c) {
  v("derotation", c.derotation,
    {.choices = {"rays", "image"},
     .meaning = "how the vehicle's own turning is taken away: from each followed corner's ray, or from the newer "
                "image before corners are followed"});
  v("across", c.across,
    {.choices = {"heading", "walls"}, .meaning = "whether distances aside are square to the heading or to the walls"});
  v("features", c.features, {.meaning = "how corners are found and followed"});
  v("regions", c.regions, {.meaning = "where walls are looked for"});
  v("limits", c.limits, {.meaning = "which flow counts as wrong"});
  v("approach", c.approach, {.meaning = "how the growth of what lies ahead is measured"});
  v("least_vectors", c.least_vectors, {.at_least = 1, .meaning = "good vectors without which a side is unknown"});
  v("most_slow", c.most_slow,
    {.above = 0.0,
     .at_most = 1.0,
     .meaning =
         "share of a side's corners too slow to tell a distance above which it is unknown: the rest are the near "
         "ones"});
  v("most_turned", c.most_turned_rad,
    {.unit = "deg",
     .at_least = 0.0,
     .at_most = 60.0,
     .meaning = "greatest angle between the heading and the walls that is looked for"});
  v("attitude_lag", c.attitude_lag_s,
    {.unit = "s", .at_least = 0.0, .at_most = 0.1, .meaning = "by which the attitude estimated lags, as the gyros do"});
}

/// The camera, its last image and where the vehicle was then.
class CorridorSight {
 public:
  static constexpr const char* kRole = "fisheye";

  /// Throws std::invalid_argument on a bad config. @param camera  looks down or so; any lens.
  CorridorSight(const CorridorSightConfig& config, const MountedCamera& camera);

  /// Takes in an image. @return what it shows together with the one before; nothing for the first.
  std::optional<CorridorView> update(const CameraFrame& frame, const NavigationState& navigation);

  const cv::Mat& image() const { return image_; }  ///< CV_8UC1, the last
  const std::array<cv::Mat, vision::corridor::kRegions>& regions() const { return regions_; }

 private:
  vision::corridor::CameraMotion motion(const NavigationState& now, double dt_s) const;
  vision::corridor::SideDistance side(const std::vector<vision::corridor::WallPoint>& points,
                                      vision::corridor::Region side) const;

  CorridorSightConfig config_;
  MountedCamera camera_;
  std::array<cv::Mat, vision::corridor::kRegions> regions_;
  vision::camera::ImageDerotator turner_;
  vision::corridor::ApproachMeter approach_;
  cv::Mat image_;
  int64_t t_ns_ = -1;
  NavigationState navigation_;  ///< at the last image, without the lag
};

}  // namespace hedgehop::avoidance::corridor_centering
