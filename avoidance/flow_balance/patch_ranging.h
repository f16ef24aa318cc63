#pragma once

#include <Eigen/Core>
#include <vector>

#include "avoidance/flow_balance/lasting_ranges.h"
#include "avoidance/flow_balance/range_memory.h"
#include "avoidance/flow_balance/ranging.h"

namespace hedgehop::avoidance::flow_balance {

/// Ranges of single patches, each by its own flow. A side is as near as the mean of its nearest tenth of patches.
/// The flow must be derotated. Ours.
class PatchRanging final : public Ranging {
 public:
  struct Options {
    double floor_mps = 0.2;  ///< see vision::flow::inverse_depth_per_m(), > 0
    double memory_s = 0.0;   ///< see RangeMemory, >= 0
    int images = 3;          ///< see LastingRanges, at least 1
  };
  explicit PatchRanging(const Options& options);

  void update(const SideCameras& cameras, const NavigationState& navigation) override;
  /// A side counts as far while its camera's measure is missing or too old.
  PerSide nearest_per_m() const override { return nearest_per_m_; }
  /// Counts the patches that lie within 60 degrees of the path.
  PerSide left_once_stopped_per_m(const Approach& approach) const override;

  /// The columns of one camera, from left to right: of each the mean of its nearest quarter of patches, for sky, ground
  /// and far roofs must not hide a wall between them. Empty before the first image.
  std::vector<RangeColumn> columns(size_t side) const;

 private:
  struct Side {
    RangeMemory memory;
    LastingRanges lasting;
    std::vector<Eigen::Vector2d> directions_H;  ///< of the patches, level, length 1
    std::vector<double> weights;                ///< of the last image's patches, 0 for one without flow
    int cols = 0;
  };
  void add_image(const CameraFlow& camera, const NavigationState& navigation, double dt_s, Side& side) const;

  Options options_;
  std::vector<Side> sides_;  ///< in the order of kSideRoles
  PerSide nearest_per_m_{};
};

}  // namespace hedgehop::avoidance::flow_balance
