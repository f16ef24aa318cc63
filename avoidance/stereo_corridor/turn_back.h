#pragma once

#include <Eigen/Core>
#include <limits>

namespace hedgehop::avoidance::stereo_corridor {

/// Decides when a vehicle that sees ahead only turns on the spot towards a goal that it has passed: as soon as the goal
/// recedes and lies a meter behind, and until it lies ahead. Every turn doubles that meter, so that a long detour is
/// still flown, until the goal has been closer than ever. Ours.
class TurnBack {
 public:
  /// @param p_CG_C  the goal, from the camera, m. @return whether to turn towards it on the spot now.
  bool update(const Eigen::Vector3d& p_CG_C);

 private:
  static constexpr double kMayPassM = 1.0;
  double may_pass_m_ = kMayPassM;
  double nearest_m_ = std::numeric_limits<double>::infinity();  ///< to the goal, since the last turn
  double nearest_ever_m_ = std::numeric_limits<double>::infinity();
  bool turning_ = false;
};

}  // namespace hedgehop::avoidance::stereo_corridor
