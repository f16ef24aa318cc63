#pragma once

#include <Eigen/Core>
#include <vector>

#include "avoidance/module.h"

namespace hedgehop::avoidance::landmark_map {

/// The thesis's lateral flight: a circle about an object that the nose keeps pointing at, level. [Shah2009] ch. 4.
struct Orbit {
  double north_m = 0.0, east_m = 0.0;
  double rate_radps = 6.283185307179587e-3;  ///< 0.36 deg/s, [Shah2009] table 4.1
};
template <class Visitor>
void describe(Visitor& v, Orbit& c) {
  v("north", c.north_m, {.unit = "m", .meaning = "of the object in the middle"});
  v("east", c.east_m, {.unit = "m", .meaning = "of the object in the middle"});
  v("rate", c.rate_radps, {.unit = "deg/s", .meaning = "round it, clockwise seen from above"});
}

/// Returns the velocity along the circle through `start_NE`, with a correction of radius errors.
/// @param start_NE  where the flight began, m. @param at_NE  the vehicle, m. @param altitude_m  to hold.
/// Source: [Shah2009] eq. (4.1), its rates. Differs: a flight is blown off its circle, so its radius is controlled.
VelocityCommand orbit_command(const Orbit& orbit, const Eigen::Vector2d& start_NE, const Eigen::Vector2d& at_NE,
                              double altitude_m);

/// Returns the circle as a closed line of 72 sides, from its start, m.
std::vector<Eigen::Vector2d> orbit_course(const Orbit& orbit, const Eigen::Vector2d& start_NE);

}  // namespace hedgehop::avoidance::landmark_map
