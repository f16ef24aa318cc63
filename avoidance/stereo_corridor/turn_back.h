#pragma once

#include <Eigen/Core>
#include <limits>

namespace hedgehop::avoidance::stereo_corridor {

/// Tells a vehicle that sees ahead only when to turn on the spot for a goal that it has passed: when the goal recedes
/// and lies a meter behind, and until it lies ahead. Every turn doubles that meter, so that a long way round is still
/// flown, until the goal has come nearer than ever. Ours.
class TurnBack {
 public:
  /// @param p_CG_C  the goal in the camera's frame, m. @return whether to turn towards it on the spot now.
  bool update(const Eigen::Vector3d& p_CG_C);

 private:
  static constexpr double kMayPassM = 1.0;
  double may_pass_m_ = kMayPassM;
  double nearest_m_ = std::numeric_limits<double>::infinity();  ///< to the goal, since the last turn
  double nearest_ever_m_ = std::numeric_limits<double>::infinity();
  bool turning_ = false;
};

}  // namespace hedgehop::avoidance::stereo_corridor
