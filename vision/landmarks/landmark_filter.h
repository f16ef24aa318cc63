#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "vision/camera/pinhole_camera.h"
#include "vision/landmarks/landmark.h"

namespace hedgehop::vision::landmarks {

/// How a map of landmarks is kept. The accuracies are what the filter believes, not what the sensors do.
struct LandmarkMapConfig {
  LandmarkStart start;
  double pixel_sigma_px = 0.7;
  double position_sigma_m = 0.43;      ///< 1 % of 140 ft, [Shah2009] table 4.1
  double attitude_sigma_rad = 6.3e-4;  ///< 0.01 % of a full turn, [Shah2009] table 4.1
  double correlation_s = 0.0;
  double drift_m_rt_s = 0.0;
  double gate = 4.0;  ///< residuals of 4 standard deviations
  int misses = 30;    ///< N of [Shah2009] ch. 4
  int young_misses = 3;
  int confirm = 10;
};

template <class Visitor>
void describe(Visitor& v, LandmarkMapConfig& c) {
  v("start", c.start.coordinates,
    {.choices = {"ground", "inverse_depth"}, .meaning = "where a landmark begins: on the ground, or at any depth"});
  v("ground_sigma", c.start.ground_sigma,
    {.above = 0.0, .meaning = "standard deviation of the depth of a start on the ground, as a share of it"});
  v("nearest", c.start.nearest_m,
    {.unit = "m", .above = 0.0, .meaning = "of a start by inverse depth: landmarks may lie as near as this"});
  v("beyond_horizon", c.start.beyond_horizon_m,
    {.unit = "m", .above = 0.0, .meaning = "depth of a start on the ground whose ray does not meet it nearer"});
  v("pixel_sigma", c.pixel_sigma_px,
    {.unit = "px", .above = 0.0, .meaning = "standard deviation of a corner in an image, per axis"});
  v("position_sigma", c.position_sigma_m,
    {.unit = "m", .at_least = 0.0, .meaning = "standard deviation of the position's error, per axis"});
  v("attitude_sigma", c.attitude_sigma_rad,
    {.unit = "deg", .at_least = 0.0, .meaning = "standard deviation of the attitude's error, per axis"});
  v("correlation", c.correlation_s,
    {.unit = "s",
     .at_least = 0.0,
     .meaning = "how long errors of position and attitude stay alike; images within it do not average them out"});
  v("drift", c.drift_m_rt_s,
    {.unit = "m/sqrt(s)", .at_least = 0.0, .meaning = "growth of a landmark's standard deviation: process noise"});
  v("gate", c.gate, {.above = 0.0, .meaning = "largest Z value of a match; n standard deviations have n^2 / 4"});
  v("misses", c.misses,
    {.at_least = 1, .meaning = "a landmark in view but unmatched in so many images running is deleted"});
  v("young_misses", c.young_misses, {.at_least = 1, .meaning = "the same for one that is not yet confirmed"});
  v("confirm", c.confirm, {.at_least = 1, .meaning = "matches that make a landmark part of the map"});
}

/// A landmark with its history.
struct MappedLandmark {
  int64_t id = 0;  ///< counted from 0 in the order of their first sight
  Landmark landmark;
  int matches = 0;  ///< images in which it was seen, the first included
  int misses = 0;   ///< images running in which it was in view and not seen
};

/// The map of [Shah2009] ch. 4, sec. "3D Modeling Algorithm": a database of landmarks that images correct, add to and
/// delete from. Differs: landmarks that are part of the map are matched before those that are not yet.
class LandmarkMap {
 public:
  /// @param bearing scale and edges of the images come from `camera`.
  /// Throws std::invalid_argument, naming the key, on a bad config.
  LandmarkMap(const LandmarkMapConfig& config, const camera::PinholeCamera& camera);

  /// Takes in one image's corners. @param corners_px  in the image. @param dt_s  since the last image, >= 0.
  /// @return for each corner the id of its landmark, new or known.
  std::vector<int64_t> update(std::span<const Eigen::Vector2d> corners_px, const CameraPose& pose, double dt_s);

  /// All landmarks, in rising order of id.
  const std::vector<MappedLandmark>& landmarks() const { return landmarks_; }
  bool confirmed(const MappedLandmark& landmark) const { return landmark.matches >= config_.confirm; }

 private:
  using Predictions = std::vector<std::optional<PredictedBearing>>;

  Predictions predict(const CameraPose& pose) const;
  void drop_missed(const CameraPose& pose, const std::vector<bool>& seen);

  LandmarkMapConfig config_;
  camera::PinholeCamera camera_;
  double bearing_sigma_;
  int64_t next_id_ = 0;
  std::vector<MappedLandmark> landmarks_;
};

}  // namespace hedgehop::vision::landmarks
