#pragma once

#include <Eigen/Core>
#include <span>

#include "avoidance/flow_balance/ranging.h"

/// Our additions to the goal-directed law of balance_law.h.
namespace hedgehop::avoidance::flow_balance {

/// Returns the velocity to add to the target velocity, in H, m/s: each camera pushes back along its axis by `gain_m2ps`
/// times the inverse range of the nearest obstacle on its side. With a gain of k0 + k1 it equals push_from_walls()
/// before walls at right angles to a camera's axis. It also holds for what a camera sees at its edge, and for what lies
/// straight ahead of the motion.
/// @param inverse_ranges_per_m  per side, >= 0.
Eigen::Vector2d push_from_ranges(const SideAxes& axes_H, const PerSide& inverse_ranges_per_m, double gain_m2ps);

/// Returns a command after a first-order low-pass filter, m/s. [Garratt2009] sec. 4.1 suggests one.
/// @param v_last_W  the last filtered command, m/s.  @param dt_s  since then, >= 0.
/// @param time_constant_s  0 for no filter.
Eigen::Vector2d low_pass(const Eigen::Vector2d& v_last_W, const Eigen::Vector2d& v_W, double dt_s,
                         double time_constant_s);

}  // namespace hedgehop::avoidance::flow_balance
