#pragma once

#include <Eigen/Core>
#include <span>

/// The simple scheme as printed in [Garratt2009] sec. 4. Frame H: B leveled, x along the heading, y to the right.
namespace hedgehop::avoidance::flow_balance {

/// What one camera measures of the obstacles on its side.
struct SideRange {
  Eigen::Vector2d axis_H = Eigen::Vector2d::UnitX();  ///< optical axis
  double inverse_range_per_m = 0.0;                   ///< of the nearest obstacle there
  bool fresh = false;                                 ///< is there a new image since the last update?
};

/// A vehicle that flies on a diagonal of H until an obstacle is near.
struct Diagonal {
  Eigen::Vector2d speed_mps = {1.0, 1.0};  ///< along x and y of H, both > 0
  double range_threshold_m = 2.0;          ///< an obstacle within it is too near, > 0
};

/// Index of H's axis, 0 for x and 1 for y, that a camera looks along.
int component_along(const Eigen::Vector2d& axis_H);
bool is_too_near(const SideRange& side, double range_threshold_m);
/// Whether a velocity with these signs of its components leads towards what the camera of a side sees.
bool leads_towards(const Eigen::Vector2d& signs_H, const SideRange& side);

/// Flies on a diagonal. A component of the velocity that leads towards an obstacle within the threshold is reversed.
/// Source: [Garratt2009] sec. 4.
class ZigZagLaw {
 public:
  explicit ZigZagLaw(const Diagonal& diagonal) : diagonal_(diagonal) {}

  /// Velocity to fly in H, m/s; both components positive at first.
  Eigen::Vector2d velocity_H() const { return signs_H_.cwiseProduct(diagonal_.speed_mps); }
  /// Takes in what the cameras measure. @return whether a component was reversed.
  bool update(std::span<const SideRange> sides);
  /// Of components, so far.
  int reversals() const { return reversals_; }

 private:
  Diagonal diagonal_;
  Eigen::Vector2d signs_H_ = {1.0, 1.0};
  int reversals_ = 0;
};

}  // namespace hedgehop::avoidance::flow_balance
