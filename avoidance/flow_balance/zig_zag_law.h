#pragma once

#include <Eigen/Core>
#include <span>

/// The simple scheme as published in [Garratt2009] sec. 4. Frame H: B leveled, x along the heading, y to the right.
namespace hedgehop::avoidance::flow_balance {

/// Measurement of the obstacles on the side of one camera.
struct SideRange {
  Eigen::Vector2d axis_H = Eigen::Vector2d::UnitX();  ///< optical axis
  double inverse_range_per_m = 0.0;                   ///< of the nearest obstacle on that side
  bool fresh = false;                                 ///< whether there is a new image since the last update
};

/// A flight along a diagonal of H until an obstacle is near.
struct Diagonal {
  Eigen::Vector2d speed_mps = {1.0, 1.0};  ///< along x and y of H, both > 0
  double range_threshold_m = 2.0;          ///< an obstacle within this range is too near, > 0
};

/// Returns the index of the axis of H, 0 for x and 1 for y, along which a camera looks.
int component_along(const Eigen::Vector2d& axis_H);
bool is_too_near(const SideRange& side, double range_threshold_m);
/// Returns whether a velocity with these signs of its components leads towards the obstacles on a side.
bool leads_towards(const Eigen::Vector2d& signs_H, const SideRange& side);

/// Flies along a diagonal. If a component of the velocity leads towards an obstacle within the threshold, it is
/// reversed. Source: [Garratt2009] sec. 4.
class ZigZagLaw {
 public:
  explicit ZigZagLaw(const Diagonal& diagonal) : diagonal_(diagonal) {}

  /// Commanded velocity in H, m/s; both components are positive at first.
  Eigen::Vector2d velocity_H() const { return signs_H_.cwiseProduct(diagonal_.speed_mps); }
  /// Adds the measurements of the cameras. @return whether a component was reversed.
  bool update(std::span<const SideRange> sides);
  /// Number of reversed components so far.
  int reversals() const { return reversals_; }

 private:
  Diagonal diagonal_;
  Eigen::Vector2d signs_H_ = {1.0, 1.0};
  int reversals_ = 0;
};

}  // namespace hedgehop::avoidance::flow_balance
