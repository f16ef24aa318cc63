#pragma once

#include "vision/corridor/corridor_flow.h"

/// How corridor_centering steers, as pure functions. Frame H: B turned level, x along the heading, y to the right.
namespace hedgehop::avoidance::corridor_centering {

/// The printed controller's gains. Source: [Zingg2010] eq. (13) and (14).
struct CenteringGains {
  double kp = 0.2;    ///< on the change of the error from one sample to the next
  double kd = 0.009;  ///< on the error itself
};

template <class Visitor>
void describe(Visitor& v, CenteringGains& c) {
  v("kp", c.kp, {.at_least = 0.0, .meaning = "on the change of the error from sample to sample"});
  v("kd", c.kd, {.at_least = 0.0, .meaning = "on the error itself"});
}

/// Returns C(z) = ((kp + kD) z - kp) / z of the centering error: roll to the right, rad, and as well turn rate to the
/// right, rad/s. Its steady gain is kD and kp multiplies the difference, the reverse of what the letters suggest.
/// @param error, last_error  e_n now and one sample ago, -1..1. Source: [Zingg2010] eq. (12).
double printed_control(const CenteringGains& gains, double error, double last_error);

/// Returns the course to the middle of the gap `ahead_m` in front, rad to the right of the heading, within `most_rad`.
/// Flown at any speed, an offset from a straight corridor's middle falls by e in every `ahead_m` of way and cannot
/// overshoot; the printed controller acts on acceleration, and its settling takes a fixed time, at any speed.
/// @param gap  both sides known. @param ahead_m  > 0.
double pursuit_course_rad(const vision::corridor::Gap& gap, double ahead_m, double most_rad);

/// What the speed leaves time for.
struct SpeedLimits {
  double speed_mps = 0.8;    ///< where nothing is near
  double aside_s = 0.8;      ///< time in which it could fly the free distance at its narrower side
  double stop_mps2 = 1.0;    ///< deceleration counted on
  double reaction_s = 0.35;  ///< from what is seen to what is done
};

template <class Visitor>
void describe(Visitor& v, SpeedLimits& c) {
  v("speed", c.speed_mps, {.unit = "m/s", .above = 0.0, .meaning = "where nothing is near"});
  v("aside", c.aside_s,
    {.unit = "s", .above = 0.0, .meaning = "time in which it could fly the clearance at its sides"});
  v("braking", c.stop_mps2, {.unit = "m/s^2", .above = 0.0, .meaning = "deceleration counted on"});
  v("reaction", c.reaction_s, {.unit = "s", .at_least = 0.0, .meaning = "from seeing to acting"});
}

/// Returns the greatest speed at which the clearance aside is flown in no less than `aside_s` and the way ahead is long
/// enough to stop in, m/s, >= 0.
/// @param aside_m, ahead_m  clearances of the hull, m; below 0 counts as 0, +inf is nothing there.
double clearance_speed_mps(double aside_m, double ahead_m, const SpeedLimits& limits);

}  // namespace hedgehop::avoidance::corridor_centering
