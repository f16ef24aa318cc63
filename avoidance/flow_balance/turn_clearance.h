#pragma once

#include <Eigen/Core>

#include "avoidance/flow_balance/ranging.h"

/// The distance from a wall that a turn leaves, for turns between two walls. Frame H: level, x along the heading, y to
/// the right. Not in the paper.
namespace hedgehop::avoidance::flow_balance {

/// A turn from one velocity to another one, both in H, m/s. The velocity is constant for the reaction time. Then it
/// changes on a straight line, with the deceleration as its acceleration, and is constant again.
struct Turn {
  Eigen::Vector2d from_H = Eigen::Vector2d::Zero();
  Eigen::Vector2d to_H = Eigen::Vector2d::Zero();
  Stopping stopping;
};

/// Returns the distance that remains from a wall, m, possibly < 0. If the new velocity leads away from the wall, it is
/// the distance at the point of the path nearest to it. If it leads towards the wall, it is the distance after a second
/// turn, by 180 degrees, which begins when the first one ends.
/// @param towards_H  direction of the wall, length 1. @param range_m  present distance of the wall.
double clearance_after_turn_m(const Turn& turn, const Eigen::Vector2d& towards_H, double range_m);

}  // namespace hedgehop::avoidance::flow_balance
