#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/core/utility.hpp>
#include <optional>
#include <span>
#include <vector>

#include "avoidance/law.h"
#include "avoidance/module.h"
#include "sim/fields/field.h"
#include "vision/landmarks/edge_corners.h"
#include "vision/landmarks/landmark_bundle.h"
#include "vision/landmarks/landmark_filter.h"

namespace hedgehop::avoidance::landmark_map {

/// Output of camera 'front': images for the corner search, or the output of a corner detector.
enum class CornerSource { grey, color, corners };

struct LandmarkObserverConfig {
  CornerSource source = CornerSource::grey;
  double least_corner_angle_rad = 0.2;
  vision::landmarks::LandmarkMapConfig map;
  vision::landmarks::LandmarkBundleConfig adjustment;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<LandmarkObserverConfig> auto& c) {
  v("source", c.source,
    {.choices = {"grey", "color", "corners"},
     .meaning = "channel of camera 'front': images for the edge search (color also uses the difference of red and "
                "green), or corners"});
  v("least_corner_angle", c.least_corner_angle_rad,
    {.unit = "deg", .above = 0.0, .at_most = 90.0, .meaning = "minimum angle between the edges of a corner"});
  v("map", c.map, {.meaning = "estimation, matching and deletion of landmarks"});
  v("adjustment", c.adjustment,
    {.meaning = "joint estimation of camera poses and landmarks from all images; only with `law: modified`"});
}

/// Builds a map of landmarks from the frames of one camera. With `law: modified`, an adjustment of all images
/// (vision/landmarks/landmark_bundle.h) corrects the filter every 2 s.
class LandmarkObserver {
 public:
  /// @param law  law of the map. Throws std::invalid_argument on a bad config.
  LandmarkObserver(const LandmarkObserverConfig& config, Law law, const MountedCamera& camera);

  static CameraNeed need(const LandmarkObserverConfig& config);

  /// Adds a frame. @return false if it is not newer than the last one.
  bool update(const CameraFrame& frame, const NavigationState& navigation);

  const vision::landmarks::LandmarkMap& map() const { return map_; }
  const std::vector<Eigen::Vector2d>& corners_px() const { return corners_px_; }  ///< of the last frame
  const vision::landmarks::CameraPose& pose() const { return pose_; }             ///< of the last frame
  vision::camera::PinholeCamera camera() const { return camera_.model.pinhole(); }
  const cv::Mat& grey() const {
    return grey_;
  }  ///< the last image, CV_8UC1; empty before the first image and without images
  /// Total wall time of the filter and the adjustment, for reports only.
  double filter_ms() const { return filter_time_.getTimeMilli(); }

 private:
  void adjust(const NavigationState& navigation, const Eigen::Isometry3d& X_WB_est, double dt_s,
              std::span<const int64_t> ids);

  LandmarkObserverConfig config_;
  MountedCamera camera_;
  vision::landmarks::LandmarkMap map_;
  std::optional<vision::landmarks::LandmarkBundle> bundle_;  ///< only with `law: modified`
  vision::landmarks::CameraPose pose_;
  std::vector<Eigen::Vector2d> corners_px_;
  cv::Mat grey_;
  std::optional<int64_t> last_t_ns_;
  cv::TickMeter filter_time_;
};

}  // namespace hedgehop::avoidance::landmark_map
