#pragma once

#include <Eigen/Core>
#include <vector>

/// Our additions to the goal-directed law of balance_law.h.
namespace hedgehop::avoidance::flow_balance {

/// Returns the velocity to add to the target velocity, in W, m/s. In each quarter of the plan, the first about the aim,
/// the three nearest places push back along their directions, together by `gain_m2ps` times their mean inverse range.
/// With a gain of k0 + k1 and walls at right angles to the aim it equals push_from_walls(). It also holds for what a
/// camera sees at its edge, and for what lies straight ahead of the motion.
/// @param places_W  from the vehicle, m. @param aim_W  direction to fly, not zero.
Eigen::Vector2d push_from_places(const std::vector<Eigen::Vector2d>& places_W, const Eigen::Vector2d& aim_W,
                                 double gain_m2ps);

/// Returns a command after a first-order low-pass filter, m/s. [Garratt2009] sec. 4.1 suggests one.
/// @param v_last_W  the last filtered command, m/s.  @param dt_s  since then, >= 0.
/// @param time_constant_s  0 for no filter.
Eigen::Vector2d low_pass(const Eigen::Vector2d& v_last_W, const Eigen::Vector2d& v_W, double dt_s,
                         double time_constant_s);

}  // namespace hedgehop::avoidance::flow_balance
