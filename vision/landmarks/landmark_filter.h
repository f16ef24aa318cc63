#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/fields/field.h"
#include "vision/camera/pinhole_camera.h"
#include "vision/landmarks/landmark.h"

namespace hedgehop::vision::landmarks {

/// Whose algorithm keeps the map.
enum class MapAlgorithm {
  published,  ///< [Shah2009] ch. 4 alone: update_as_published()
  modified,   ///< with the camera's common error, starts at any depth, and confirmation
};

/// How a map of landmarks is kept. The uncertainties are what the filter assumes, not what the sensors do. Members
/// without a key are the caller's choice, not the user's.
struct LandmarkMapConfig {
  MapAlgorithm algorithm = MapAlgorithm::modified;
  LandmarkStart start;  ///< ours; the published law begins on the ground
  double gate = 4.0;    ///< > 0: largest Z value of a match; n standard deviations have n^2 / 4
  /// N of [Shah2009] ch. 4, >= 1: a landmark is deleted after so many consecutive misses. Not printed; 3 s of 10 Hz.
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
    {.unit = "m", .at_least = 0.0, .meaning = "standard deviation of the position's error, per axis"});
  v("attitude_sigma", c.attitude_sigma_rad,
    {.unit = "deg", .at_least = 0.0, .meaning = "standard deviation of the attitude's error, per axis"});
  v("correlation", c.correlation_s,
    {.unit = "s",
     .at_least = 0.0,
     .meaning = "correlation time of the errors of position and attitude; images within it do not average them out"});
  v("drift", c.drift_m_rt_s,
    {.unit = "m/sqrt(s)", .at_least = 0.0, .meaning = "growth of a landmark's standard deviation: process noise"});
  v("confirm", c.confirm, {.at_least = 1, .meaning = "matches that make a landmark part of the map"});
  v("unconfirmed_misses", c.unconfirmed_misses,
    {.at_least = 1,
     .meaning = "consecutive images without it that delete a landmark in view that is not confirmed; a confirmed one "
                "stands 30"});
}

/// A database of landmarks that images correct, add to and delete from. Source: [Shah2009] ch. 4, sec. "3D Modeling
/// Algorithm"; as printed by `MapAlgorithm::published`. Differs, by `MapAlgorithm::modified`: the camera's common error
/// is estimated before landmarks are matched, confirmed landmarks are matched first, only landmarks in view can be
/// missed, and well-known ones stay when something hides them.
class LandmarkMap {
 public:
  /// @param camera  of the images: scale of the bearings, edges of the view.
  /// Throws std::invalid_argument, naming the key, on a bad config.
  LandmarkMap(const LandmarkMapConfig& config, const camera::PinholeCamera& camera);

  /// Takes in one image's corners. @param corners_px  in the image. @param dt_s  since the last image, >= 0.
  /// @return for each corner the id of its landmark, new or known.
  std::vector<int64_t> update(std::span<const Eigen::Vector2d> corners_px, const CameraPose& pose, double dt_s);

  /// All landmarks, in rising order of id.
  const std::vector<MappedLandmark>& landmarks() const { return landmarks_; }
  /// Whether a landmark is part of the map: under the published law every one.
  bool confirmed(const MappedLandmark& landmark) const {
    return config_.algorithm == MapAlgorithm::published || landmark.matches >= config_.confirm;
  }

 private:
  using Predictions = std::vector<std::optional<PredictedBearing>>;

  std::vector<int64_t> update_as_modified(std::span<const Eigen::Vector2d> bearings, const CameraPose& pose,
                                          double dt_s);
  Predictions predict(const CameraPose& pose) const;
  bool lasts(const MappedLandmark& mapped) const;
  void drop_missed(const CameraPose& pose, const std::vector<bool>& seen);

  LandmarkMapConfig config_;
  camera::PinholeCamera camera_;
  double bearing_sigma_;
  int64_t next_id_ = 0;
  std::vector<MappedLandmark> landmarks_;
};

}  // namespace hedgehop::vision::landmarks
