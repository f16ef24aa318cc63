#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "avoidance/flow_balance/zig_zag_law.h"
#include "sim/libm/random.h"

namespace hedgehop::avoidance::flow_balance {

/// The zig-zag of zig_zag_law.h with the additions of the modified law:
/// - A component is reversed only if two successive images agree.
/// - If several obstacles are too near, only the nearest one reverses a component, and the others are evaluated again
/// on the new path. Otherwise a wall that two cameras see, as at a heading across the room, would send the vehicle back
/// instead of along the wall.
/// - Each reversal may rotate the path by a random angle. At a heading across the room, fixed diagonals soon repeat one
/// closed path.
class ConfirmedZigZag {
 public:
  /// @param stray_rad  maximum angle between the path and its diagonal, >= 0; drawn at every reversal.
  /// @param seed       seed of these random angles.
  ConfirmedZigZag(const Diagonal& diagonal, double stray_rad, uint64_t seed)
      : diagonal_(diagonal), max_stray_rad_(stray_rad), random_(seed) {}

  /// Velocity to fly in H, m/s; both components positive at first.
  Eigen::Vector2d velocity_H() const;
  /// Returns whether obstacles ahead are too near on sides of both components.
  bool in_corner(std::span<const SideRange> sides) const;
  /// Adds the measurements of the cameras, always of the same cameras in the same order.
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
