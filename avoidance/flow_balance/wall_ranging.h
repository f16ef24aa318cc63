#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "avoidance/flow_balance/patch_ranging.h"
#include "avoidance/flow_balance/ranging.h"
#include "vision/flow/flow_range.h"

namespace hedgehop::avoidance::flow_balance {

/// Returns the upright walls round a vehicle by the newest flow of all its cameras, in frame H. Tilt is left out: the
/// cameras' axes are taken level as they are mounted in B.
/// @param cameras  derotated, looking level.  @param now_ns  measures that are too old by then are left out.
std::vector<vision::flow::WallEstimate> fit_walls(std::span<const CameraFlow> cameras,
                                                  const NavigationState& navigation, int64_t now_ns);

/// Ranges of upright walls that are fitted to the flow of all cameras at once. Where no wall fits, ranges of patches
/// stand in. The flow must be derotated. Ours.
class WallRanging final : public Ranging {
 public:
  explicit WallRanging(const PatchRanging::Options& patches) : patches_(patches) {}

  void update(const SideCameras& cameras, const NavigationState& navigation) override;
  /// Of the nearest patches: they also measure what is narrower than a wall.
  PerSide nearest_per_m() const override { return patches_.nearest_per_m(); }
  /// Of walls, from the vehicle's side, so that the cameras' positions do not matter.
  PerSide left_once_stopped_per_m(const Approach& approach) const override;

 private:
  double left_on_side_per_m(const Eigen::Vector2d& axis_H, const Approach& approach) const;

  PatchRanging patches_;
  SideAxes axes_H_{};
  std::vector<vision::flow::WallEstimate> walls_;
};

}  // namespace hedgehop::avoidance::flow_balance
