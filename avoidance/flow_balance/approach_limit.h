#pragma once

#include <Eigen/Core>
#include <vector>

namespace hedgehop::avoidance::flow_balance {

/// Speeds from which a vehicle can stop before obstacles. Not in the paper, whose command always has the full speed.
struct ApproachLimit {
  double stand_off_m = 0.0;   ///< range at which the approach ends, >= 0
  double braking_mps2 = 1.0;  ///< deceleration, > 0
  double reaction_s = 0.0;    ///< time before the vehicle decelerates, >= 0
};

/// Returns the maximum speed toward an obstacle, m/s: the speed v from which the vehicle stops at the stand-off range,
///   range - stand_off = v t + v^2 / (2 a) .
/// Nearer obstacles give a negative speed: the vehicle leaves the stand-off range within a second.
/// @param range_m  >= 0.
double closing_limit_mps(double range_m, const ApproachLimit& limit);

/// Returns the obstacles with another one within 2 m. A single point may come from a wrong flow vector. The face of a
/// building that is near enough to stop for has several.
/// @param obstacles_W  from the vehicle, m.
std::vector<Eigen::Vector2d> confirmed_obstacles(const std::vector<Eigen::Vector2d>& obstacles_W);

/// Returns a velocity that does not exceed closing_limit_mps() toward any obstacle, m/s. Only the components toward
/// obstacles change, so that the vehicle slides along walls. If limits contradict each other, as between two walls that
/// are both too near, the nearest obstacles have priority.
/// @param v_W  m/s. @param obstacles_W  from the vehicle, m. @param speed_mps  maximum speed of the result, >= 0.
Eigen::Vector2d limited_approach(const Eigen::Vector2d& v_W, std::vector<Eigen::Vector2d> obstacles_W,
                                 const ApproachLimit& limit, double speed_mps);

}  // namespace hedgehop::avoidance::flow_balance
