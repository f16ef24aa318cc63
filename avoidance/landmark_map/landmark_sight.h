#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/core/utility.hpp>
#include <optional>
#include <vector>

#include "avoidance/module.h"
#include "vision/landmarks/edge_corners.h"
#include "vision/landmarks/landmark_filter.h"

namespace hedgehop::avoidance::landmark_map {

/// Whose corners a map is made of: those that an image shows, or, for experiments, those that the scene has.
enum class FrontEnd { images, corners };

struct LandmarkSightConfig {
  FrontEnd front_end = FrontEnd::images;
  bool color = false;
  vision::landmarks::EdgeCornerConfig corners;
  vision::landmarks::LandmarkMapConfig map;
};

template <class Visitor>
void describe(Visitor& v, LandmarkSightConfig& c) {
  v("front_end", c.front_end,
    {.choices = {"images", "corners"},
     .meaning = "corners found in the images of camera 'front', or, for experiments, the true ones projected"});
  v("color", c.color, {.meaning = "camera 'front' shows colors, and edges are searched in them as well"});
  v("corners", c.corners, {.meaning = "which points of an image count as corners"});
  v("map", c.map, {.meaning = "how landmarks are estimated, matched and deleted"});
}

/// From the images of one camera to a map of landmarks.
class LandmarkSight {
 public:
  /// Throws std::invalid_argument on a bad config.
  LandmarkSight(const LandmarkSightConfig& config, const MountedCamera& camera);

  static CameraNeed need(const LandmarkSightConfig& config);

  /// Takes an image in. @return false when it is not newer than the last.
  bool update(const CameraFrame& frame, const NavigationState& navigation);

  const vision::landmarks::LandmarkMap& map() const { return map_; }
  const std::vector<Eigen::Vector2d>& corners_px() const { return corners_px_; }  ///< of the last image
  const vision::landmarks::CameraPose& pose() const { return pose_; }             ///< of the last image
  const cv::Mat& grey() const { return grey_; }  ///< the last image, CV_8UC1; empty before the first
  /// Wall time that the filter took so far, for reports only.
  double filter_ms() const { return filter_time_.getTimeMilli(); }

 private:
  LandmarkSightConfig config_;
  MountedCamera camera_;
  vision::landmarks::LandmarkMap map_;
  vision::landmarks::CameraPose pose_;
  std::vector<Eigen::Vector2d> corners_px_;
  cv::Mat grey_;
  std::optional<int64_t> last_t_ns_;
  cv::TickMeter filter_time_;
};

}  // namespace hedgehop::avoidance::landmark_map
