#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/fields/field.h"
#include "vision/camera/pinhole_camera.h"
#include "vision/landmarks/landmark.h"
#include "vision/landmarks/landmark_bundle.h"

namespace hedgehop::vision::landmarks {

/// Algorithm that maintains the map.
enum class MapAlgorithm {
  published,  ///< [Shah2009] ch. 4: update_as_published()
  modified,   ///< adds the common camera error, inverse depth and confirmation
};

/// Parameters of a landmark map. The uncertainties are assumptions of the filter, not properties of the sensors.
/// Members without a key are set by the calling code.
struct LandmarkMapConfig {
  MapAlgorithm algorithm = MapAlgorithm::modified;
  LandmarkStart start;  ///< for `modified`; the published algorithm starts on the ground
  double gate = 4.0;    ///< maximum Z value of a match, > 0; n standard deviations have n^2 / 4
  /// N of [Shah2009] ch. 4, >= 1: consecutive misses after which a landmark is deleted. Not in the thesis; 3 s at 10
  /// Hz.
  int misses = 30;

  double pixel_sigma_px = 0.7;
  double position_sigma_m = 0.43;      ///< 1 % of 140 ft, [Shah2009] table 4.1
  double attitude_sigma_rad = 6.3e-4;  ///< 0.01 % of a full turn, [Shah2009] table 4.1
  double correlation_s = 0.0;
  double drift_m_rt_s = 0.0;
  int confirm = 10;
  int unconfirmed_misses = 3;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<LandmarkMapConfig> auto& c) {
  v("pixel_sigma", c.pixel_sigma_px,
    {.unit = "px", .above = 0.0, .meaning = "standard deviation of a corner in an image, per axis"});
  v("position_sigma", c.position_sigma_m,
    {.unit = "m", .at_least = 0.0, .meaning = "standard deviation of the position error, per axis"});
  v("attitude_sigma", c.attitude_sigma_rad,
    {.unit = "deg", .at_least = 0.0, .meaning = "standard deviation of the attitude error, per axis"});
  v("correlation", c.correlation_s,
    {.unit = "s",
     .at_least = 0.0,
     .meaning = "correlation time of the position and attitude errors, over which images do not average them out"});
  v("drift", c.drift_m_rt_s,
    {.unit = "m/sqrt(s)", .at_least = 0.0, .meaning = "growth of a landmark's standard deviation: process noise"});
  v("confirm", c.confirm, {.at_least = 1, .meaning = "number of matches after which a landmark is part of the map"});
  v("unconfirmed_misses", c.unconfirmed_misses,
    {.at_least = 1,
     .meaning = "consecutive misses in view after which an unconfirmed landmark is deleted; 30 for a confirmed one"});
}

/// A map of landmarks that is corrected, extended and pruned with each image.
/// Source: [Shah2009] ch. 4, sec. "3D Modeling Algorithm", exactly with `MapAlgorithm::published`. Differs with
/// `MapAlgorithm::modified`: the common error of the camera pose is estimated before landmarks are matched, confirmed
/// landmarks are matched first, only landmarks in view count as missed, and well-known landmarks are kept if occluded.
class LandmarkMap {
 public:
  /// @param camera  of the images. Throws std::invalid_argument with the key on an invalid config.
  LandmarkMap(const LandmarkMapConfig& config, const camera::PinholeCamera& camera);

  /// Updates the map with the corners of an image. @param dt_s  time since the previous image, >= 0.
  /// @return for each corner the id of its landmark, new or existing.
  std::vector<int64_t> update(std::span<const Eigen::Vector2d> corners_px, const CameraPose& pose, double dt_s);

  /// Replaces estimates by those of an adjustment, rejects landmarks that are not points, and deletes duplicates. The
  /// filter continues from there until the next adjustment, which does not use the filter's estimates.
  void refine(std::span<const AdjustedLandmark> adjusted);

  /// Returns all landmarks in increasing order of id.
  const std::vector<MappedLandmark>& landmarks() const { return landmarks_; }
  /// Returns whether a landmark is part of the map; always true for the published algorithm.
  bool confirmed(const MappedLandmark& landmark) const {
    return config_.algorithm == MapAlgorithm::published || (landmark.matches >= config_.confirm && !landmark.rejected);
  }

 private:
  using Predictions = std::vector<std::optional<PredictedBearing>>;

  std::vector<int64_t> update_as_modified(std::span<const Eigen::Vector2d> bearings, const CameraPose& pose,
                                          double dt_s);
  Predictions predict(const CameraPose& pose) const;
  bool is_persistent(const MappedLandmark& mapped) const;
  void drop_missed(const CameraPose& pose, const std::vector<bool>& seen);

  LandmarkMapConfig config_;
  camera::PinholeCamera camera_;
  double bearing_sigma_;
  int64_t next_id_ = 0;
  std::vector<MappedLandmark> landmarks_;
};

}  // namespace hedgehop::vision::landmarks
