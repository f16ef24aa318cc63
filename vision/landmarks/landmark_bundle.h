#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/fields/field.h"
#include "vision/landmarks/bundle_adjustment.h"
#include "vision/landmarks/landmark.h"

namespace hedgehop::vision::landmarks {

/// Assumed errors of images, velocity and gyros. Those of position and attitude are in LandmarkMapConfig.
struct LandmarkBundleConfig {
  double pixel_sigma_px = 0.3;
  double position_drift_m_rt_s = 0.1;
  double attitude_drift_rad_rt_s = 3.5e-4;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<LandmarkBundleConfig> auto& c) {
  v("pixel_sigma", c.pixel_sigma_px,
    {.unit = "px",
     .above = 0.0,
     .meaning = "standard deviation of a corner in an image without wrong matches, per axis"});
  v("position_drift", c.position_drift_m_rt_s,
    {.unit = "m/sqrt(s)",
     .above = 0.0,
     .meaning = "growth of the error of a displacement that integrates the velocity"});
  v("attitude_drift", c.attitude_drift_rad_rt_s,
    {.unit = "rad/sqrt(s)", .above = 0.0, .meaning = "growth of the error of a rotation that integrates the gyros"});
}

/// The navigation's estimate at an image.
struct NavigationSample {
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();         ///< of B in W, m/s
  Eigen::Matrix3d R_gyro = Eigen::Matrix3d::Identity();  ///< R_WB, integrated from the gyros alone
};

/// A landmark according to the adjustment.
struct AdjustedLandmark {
  int64_t id = 0;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();           ///< m
  Eigen::Matrix3d covariance_W = Eigen::Matrix3d::Zero();  ///< m^2
  bool is_point = true;       ///< false: the landmark fits no fixed point, or two parts of the flight disagree about it
  bool is_duplicate = false;  ///< an older landmark is at the same place and now owns its bearings
};

/// Stores keyframes of a flight with the bearings of landmarks, and estimates the keyframes' poses and the landmarks
/// together. An estimate of each landmark alone inherits the navigation's error; together, the landmarks of an image
/// share it, and the velocity and the gyros connect the images. This step is not part of [Shah2009] ch. 4.
class LandmarkBundle {
 public:
  /// @param X_BC  pose of the camera in the body. @param noise  of an image; see BundleNoise.
  /// @param correlation_s  correlation time of the navigation's errors, s, >= 0; keyframes within it count as one.
  LandmarkBundle(const Eigen::Isometry3d& X_BC, const BundleNoise& noise, double correlation_s);

  /// Adds an image. @param dt_s  since the previous image, > 0 except for the first.
  /// @param bearings  at focal length 1. @param ids  of their landmarks, of equal size.
  void add(const NavigationSample& navigation, double dt_s, std::span<const Eigen::Vector2d> bearings,
           std::span<const int64_t> ids);

  /// Returns whether enough keyframes were added since the last adjustment.
  bool is_due() const { return since_adjusted_ >= kKeyframesPerAdjustment; }

  /// Estimates all landmarks that enough keyframes observe. @param landmarks  in increasing order of id.
  std::vector<AdjustedLandmark> adjust(std::span<const MappedLandmark> landmarks);

  static constexpr double kKeyframeS = 0.5;
  static constexpr int kKeyframesPerAdjustment = 4;
  static constexpr size_t kMaxKeyframes = 300;  ///< with more, every second keyframe is dropped

 private:
  struct Seen {
    int64_t id = 0;
    Eigen::Vector2d bearing = Eigen::Vector2d::Zero();
  };
  struct Keyframe {
    BundleFrame frame;
    std::vector<Seen> seen;
  };

  void halve();
  void select(std::span<const MappedLandmark> landmarks);
  bool is_consistent(size_t point) const;
  void merge(std::vector<AdjustedLandmark>& adjusted);
  bool in_one_image(int64_t a, int64_t b) const;

  Eigen::Isometry3d X_BC_;
  BundleNoise noise_;
  double correlation_s_;
  NavigationSample last_, last_key_;
  Eigen::Vector3d step_W_ = Eigen::Vector3d::Zero();
  double since_keyframe_s_ = 0.0;
  int since_adjusted_ = 0;
  std::vector<Keyframe> keyframes_;
  // Of the adjustment in progress: frames, points, and the points' ids.
  std::vector<BundleFrame> frames_;
  std::vector<Eigen::Vector3d> points_W_;
  std::vector<int64_t> ids_;
};

}  // namespace hedgehop::vision::landmarks
