#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <random>
#include <span>
#include <string_view>
#include <vector>

#include "avoidance/module.h"
#include "sim/libm/random.h"
#include "sim/loop/imperfections.h"
#include "sim/loop/shutter.h"
#include "sim/loop/ticks.h"
#include "sim/render/renderer.h"
#include "sim/scenario/failures.h"
#include "sim/scenario/rig.h"
#include "vision/camera/camera.h"

namespace hedgehop::sim {

/// An ideal corner detector in a camera's place, made from the truth: positions of those known corners of the scene
/// that lie in the image, even if occluded, each with white noise. It is the front end of [Shah2009] ch. 4,
/// which has no images.
class CornerDetector {
 public:
  /// @param corners_W  m. @param noise_px  standard deviation per axis, >= 0. @param seed  of the noise's stream.
  CornerDetector(std::vector<Eigen::Vector3d> corners_W, double noise_px, uint64_t seed);

  /// Returns the frame of a camera. @param X_WC  its pose, true. Each call draws new noise.
  /// @return N x 1, CV_64FC2: (u, v), px, in the order of the corners; the noise may carry one over the image's edge.
  cv::Mat detect(const vision::camera::Camera& camera, const Eigen::Isometry3d& X_WC);

  /// Returns an empty detection: 0 x 1, CV_64FC2.
  static cv::Mat nothing() { return cv::Mat(0, 1, CV_64FC2); }

 private:
  std::vector<Eigen::Vector3d> corners_W_;
  double noise_px_;
  RandomStream noise_;
};

/// The cameras of the rig in flight: their exposure times and last frames. All cameras that expose on one tick are
/// rendered from the same vehicle state and from their true poses, which may differ from the calibration.
class Cameras {
 public:
  /// @param renderer  of the scene; outlives the cameras. @param seed  of the flight; each camera has its own stream.
  /// Throws InputError for a camera that the context cannot draw, or a corner detector in a scene without known
  /// corners.
  /// @param failures  of the scenario; those of cameras are taken.
  Cameras(const RigConfig& rig, const Ticks& ticks, const scenes::Scene& scene, Renderer& renderer, uint64_t seed,
          std::span<const FailureConfig> failures = {});

  size_t count() const { return frames_.size(); }
  /// Index of a role. Throws std::out_of_range for a role the rig does not have.
  size_t index(std::string_view role) const;
  bool due(size_t camera, int64_t tick) const { return tick % periods_[camera] == 0; }

  /// Returns one camera's frame of this instant, with its imperfections; draws it on the first call of the instant.
  /// @return null when the frame is lost.
  const avoidance::CameraFrame* expose(size_t camera, int64_t t_ns, const BodyMotion& body);
  /// Images of all cameras at this instant for films, also of those that deliver corners; the frames of expose() stay
  /// as they are.
  std::span<const avoidance::CameraFrame> snapshot(int64_t t_ns, const Eigen::Isometry3d& X_WB);

  /// An instant of the flight.
  struct Instant {
    int64_t t_ns = 0;
    BodyMotion body;
  };
  /// One camera's image of an instant in a channel of the caller's choice, with the shutter's and the sensor's
  /// imperfections, at the present gain of automatic exposure. @param next  second instant of the optic flow, for
  /// ImageChannel::flow.
  cv::Mat image(size_t camera, ImageChannel channel, const Instant& now, const Instant& next) const;

  /// CV_8UC1: 255 for pixels of moving objects, else 0.
  cv::Mat moving(size_t camera, const Instant& now) const;

  /// Returns the calibrated camera, for onboard use.
  const avoidance::MountedCamera& mounted(size_t camera) const { return mounted_[camera]; }
  std::span<const avoidance::MountedCamera> mounted() const { return mounted_; }
  /// Returns the camera with its true pose, for the verdict.
  const avoidance::MountedCamera& truly_mounted(size_t camera) const { return truly_mounted_[camera]; }
  int64_t period_ticks(size_t camera) const { return periods_[camera]; }

 private:
  Imperfections::FrameFault frame_fault(size_t camera, int64_t t_ns) const;
  int64_t image_number(size_t camera, int64_t t_ns) const { return ticks_.tick(t_ns) / periods_[camera]; }
  void sense(size_t camera, const Instant& now, bool dead, cv::Mat& out);
  void draw(size_t camera, ImageChannel channel, const Instant& now, const Instant& next, cv::Mat& out) const;
  double image_speed_pxps(size_t camera, const Instant& now) const;

  const Ticks ticks_;
  Renderer& renderer_;
  std::vector<ImageChannel> channels_;  ///< to draw; grey for a corner detector
  std::vector<std::optional<CornerDetector>> detectors_;
  std::vector<int> samples_;
  std::vector<int64_t> periods_;  ///< ticks
  std::vector<avoidance::MountedCamera> mounted_, truly_mounted_;
  std::vector<std::pair<scenes::Motion, double>> movers_;  ///< with the reach of their solids, m
  bool movers_are_spread_;                                 ///< over kilometers: each has an image speed of its own
  int first_mover_label_;
  std::vector<Imperfections> imperfections_;
  std::vector<Shutter> shutters_;
  std::vector<FailureConfig> failures_;
  std::vector<int64_t> exposed_ns_;  ///< when each camera last exposed an image, lost ones included
  std::vector<avoidance::CameraFrame> frames_, snapshot_;
};

}  // namespace hedgehop::sim
