#pragma once

#include <Eigen/Core>
#include <vector>

#include "avoidance/camera_flow.h"
#include "avoidance/flow_balance/lasting_ranges.h"
#include "avoidance/flow_balance/range_memory.h"

namespace hedgehop::avoidance::flow_balance {

/// Returns the velocity of a camera mounted at `X_BC`, as estimated, in C, m/s.
Eigen::Vector3d velocity_in_camera(const Eigen::Isometry3d& X_BC, const NavigationState& navigation);

/// Inverse ranges of one camera's patches, each by its own flow, from image to image.
class CameraRanges {
 public:
  struct Options {
    double floor_mps = 0.2;  ///< see vision::flow::inverse_depth_per_m(), > 0
    double memory_s = 0.0;   ///< see RangeMemory, >= 0
    int images = 3;          ///< see LastingRanges, at least 1
  };
  explicit CameraRanges(const Options& options)
      : options_(options), memory_(options.memory_s), lasting_(options.images) {}

  /// Takes in a camera's newest flow, `dt_s` (> 0) after the image before.
  void update(const CameraFlow& camera, const NavigationState& navigation, double dt_s);

  /// Inverse horizontal range of every patch, 1/m, >= 0; 0 for what is far or unknown.
  std::vector<double> near_per_m() const { return lasting_.lasting_per_m(); }

 private:
  Options options_;
  RangeMemory memory_;
  LastingRanges lasting_;
};

}  // namespace hedgehop::avoidance::flow_balance
