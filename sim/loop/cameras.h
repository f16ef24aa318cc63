#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "avoidance/module.h"
#include "sim/loop/ticks.h"
#include "sim/render/renderer.h"
#include "sim/scenario/drawing.h"
#include "sim/scenario/rig.h"

namespace hedgehop::sim {

/// The rig in flight: which camera exposes when, and what each saw last. All cameras that expose on one tick are drawn
/// from the same vehicle state.
class Cameras {
 public:
  Cameras(const RigConfig& rig, const Ticks& ticks, const scenes::Scene& scene, const DrawingConfig& drawing);

  size_t count() const { return frames_.size(); }
  /// Index of a role. Throws std::out_of_range for a role the rig does not have.
  size_t index(std::string_view role) const;
  bool due(size_t camera, int64_t tick) const { return tick % periods_[camera] == 0; }

  /// Draws one camera's picture of this instant; does nothing when it holds it already.
  const avoidance::CameraFrame& expose(size_t camera, int64_t t_ns, const Eigen::Isometry3d& X_WB);
  /// Pictures of all cameras at this instant for somebody who only looks on; what modules are shown stays untouched.
  std::span<const avoidance::CameraFrame> snapshot(int64_t t_ns, const Eigen::Isometry3d& X_WB);

  /// An instant of the flight.
  struct Instant {
    double t_s = 0.0;
    Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  };
  /// One camera's picture of an instant in a channel of the caller's choice. @param next  what Channel::flow leads to.
  cv::Mat picture(size_t camera, Channel channel, const Instant& now, const Instant& next);

  const avoidance::MountedCamera& mounted(size_t camera) const { return mounted_[camera]; }
  std::span<const avoidance::MountedCamera> mounted() const { return mounted_; }
  int64_t period_ticks(size_t camera) const { return periods_[camera]; }

 private:
  void draw(size_t camera, int64_t t_ns, const Eigen::Isometry3d& X_WB, avoidance::CameraFrame& frame);

  Renderer renderer_;
  std::vector<Channel> channels_;
  std::vector<int64_t> periods_;  ///< ticks
  std::vector<avoidance::MountedCamera> mounted_;
  std::vector<avoidance::CameraFrame> frames_, snapshot_;
};

}  // namespace hedgehop::sim
