#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "avoidance/flow_balance/zig_zag_law.h"
#include "sim/libm/random.h"

namespace hedgehop::avoidance::flow_balance {

/// The zig-zag of zig_zag_law.h with our additions. A component is reversed only when two successive images agree. Of
/// several obstacles that are too near, only the nearest reverses one, and the others are judged again on the new path:
/// a wall that two cameras see, as at a heading across the room, would else send the vehicle back where it came from
/// instead of along the wall. And each reversal may rotate the path by a random angle: at a heading across the room,
/// fixed diagonals soon repeat one closed path.
class ConfirmedZigZag {
 public:
  /// @param stray_rad  the path's largest angle off its diagonal, drawn at every reversal; >= 0.
  /// @param seed       of those draws.
  ConfirmedZigZag(const Diagonal& diagonal, double stray_rad, uint64_t seed)
      : diagonal_(diagonal), max_stray_rad_(stray_rad), random_(seed) {}

  /// Velocity to fly in H, m/s; both components positive at first.
  Eigen::Vector2d velocity_H() const;
  /// Whether obstacles that the path leads towards are too near on sides of both components.
  bool in_corner(std::span<const SideRange> sides) const;
  /// Takes in what the cameras measure, the same ones in the same order every time.
  /// @return whether a component was reversed.
  bool update(std::span<const SideRange> sides);
  int reversals() const { return reversals_; }

 private:
  Diagonal diagonal_;
  double max_stray_rad_;
  Random random_;
  Eigen::Vector2d signs_H_ = {1.0, 1.0};
  double stray_rad_ = 0.0;
  std::vector<int> confirmed_;  ///< per side, successive images with an obstacle that is too near
  int reversals_ = 0;
};

}  // namespace hedgehop::avoidance::flow_balance
