#pragma once

#include <Eigen/Core>
#include <array>

#include "avoidance/flow_balance/side_cameras.h"
#include "avoidance/flow_balance/stopping.h"
#include "avoidance/module.h"

namespace hedgehop::avoidance::flow_balance {

/// One number per side, in the order of kSideRoles.
using PerSide = std::array<double, kSideCount>;

/// How the vehicle moves towards obstacles and how it would stop.
struct Approach {
  Eigen::Vector2d v_H = Eigen::Vector2d::Zero();      ///< velocity in H, m/s
  Eigen::Vector2d v_cmd_H = Eigen::Vector2d::Zero();  ///< velocity that it is to fly, in H, m/s
  Stopping stopping;
  double tail_m = 0.0;         ///< the vehicle reaches so much farther aft than to its other sides, >= 0
  bool reverses_both = false;  ///< both components of the velocity are reversed at once, as in a corner
};

/// What a column of a camera's patches measures.
struct RangeColumn {
  Eigen::Vector2d direction_H = Eigen::Vector2d::UnitX();  ///< level, length 1
  double inverse_range_per_m = 0.0;                        ///< of what is near in it; 0 where nothing is known
  double weight = 0.0;  ///< mean of vision::flow::parallax_weights(), patches without flow counting 0
};

/// A method to get ranges from the flow of four cameras.
class Ranging {
 public:
  virtual ~Ranging() = default;

  /// Takes in what the cameras measured last.
  virtual void update(const SideCameras& cameras, const NavigationState& navigation) = 0;
  /// Returns the inverse range of the nearest obstacle on each side, 1/m; 0 where none is known.
  virtual PerSide nearest_per_m() const = 0;
  /// Returns the same, of obstacles that bar the path only, and of the range that is left once the vehicle has stopped.
  virtual PerSide left_once_stopped_per_m(const Approach& approach) const = 0;
};

}  // namespace hedgehop::avoidance::flow_balance
