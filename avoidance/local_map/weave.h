#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "avoidance/local_map/stop_planner.h"

namespace hedgehop::avoidance::local_map {

/// Flight to the left and right of a position instead of a hover, for depth from motion: a camera that does not move
/// measures no depth, and one that moves sideways measures it straight ahead too.
class Weave {
 public:
  static constexpr double kAsideM = 0.5;  ///< from the position to each end
  static constexpr double kLegS = 2.0;    ///< maximum duration of a leg: known space may end before

  /// Returns the end to fly to. The position is that of the first call, or of the first call after a pause.
  /// @param now  time increases from call to call. @param heading_rad  of the nose, from north to east.
  Eigen::Vector2d target_W(const PathState& now, double heading_rad) {
    constexpr double kPauseS = 1.0, kThereM = 0.15;
    if (!center_W_ || now.t_s > last_s_ + kPauseS) {
      center_W_ = now.p_W;
      leg_since_s_ = now.t_s;
    }
    last_s_ = now.t_s;
    const Eigen::Vector2d right_W(-std::sin(heading_rad), std::cos(heading_rad));
    const auto end_W = [&] { return Eigen::Vector2d(*center_W_ + side_ * kAsideM * right_W); };
    if ((end_W() - now.p_W).norm() < kThereM || now.t_s > leg_since_s_ + kLegS) {
      side_ = -side_;
      leg_since_s_ = now.t_s;
    }
    return end_W();
  }

 private:
  std::optional<Eigen::Vector2d> center_W_;
  double side_ = 1.0;  ///< 1: right, -1: left
  double leg_since_s_ = 0.0, last_s_ = 0.0;
};

}  // namespace hedgehop::avoidance::local_map
