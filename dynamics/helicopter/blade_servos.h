#pragma once

#include <Eigen/Core>

#include "dynamics/actuators.h"
#include "sim/fields/field.h"

namespace hedgehop::dynamics::helicopter {

/// Blade angles of a helicopter, commanded to the servos or reached by them.
struct BladeAngles {
  double collective_rad = 0.0;    ///< main rotor, at 3/4 radius; positive climbs
  double lateral_rad = 0.0;       ///< cyclic; positive tilts the disc right and rolls right
  double longitudinal_rad = 0.0;  ///< cyclic; positive tilts the disc back and pitches up
  double tail_rad = 0.0;          ///< tail rotor collective, at 3/4 radius; positive opposes the main rotor's torque
};

inline Controls to_controls(const BladeAngles& b) {
  return {b.collective_rad, b.lateral_rad, b.longitudinal_rad, b.tail_rad};
}
inline BladeAngles to_blade_angles(const Controls& c) { return {c[kHeave], c[kRoll], c[kPitch], c[kYaw]}; }

/// A position servo of a blade angle: second order, with stops and a rate limit.
/// Defaults: the helicopter simulator of the autopilot project (autopilot.sourceforge.net); the rate limit is an
/// estimate.
struct ServoConfig {
  double natural_frequency_radps = 38.2261;
  double damping = 0.5118;
  double lowest_rad = -0.139626340159546;  ///< -8 deg
  double highest_rad = 0.139626340159546;  ///< > lowest
  double rate_limit_radps = 5.0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<ServoConfig> auto& c) {
  v("natural_frequency", c.natural_frequency_radps,
    {.unit = "rad/s", .above = 0.0, .at_most = 300.0, .meaning = "natural frequency of the second-order response"});
  v("damping", c.damping, {.above = 0.0, .at_most = 2.0, .meaning = "damping ratio"});
  v("lowest", c.lowest_rad,
    {.unit = "deg", .at_least = -45.0, .at_most = 45.0, .meaning = "lower stop, as a blade angle"});
  v("highest", c.highest_rad,
    {.unit = "deg", .at_least = -45.0, .at_most = 45.0, .meaning = "upper stop, as a blade angle"});
  v("rate_limit", c.rate_limit_radps, {.unit = "rad/s", .above = 0.0, .meaning = "maximum rate of the blade angle"});
}

struct ServoState {
  double position_rad = 0.0;
  double rate_radps = 0.0;
};

/// Throws std::invalid_argument unless the lower stop is below the upper one.
void check(const ServoConfig& config);

/// Returns the time derivative (rate, acceleration): y'' = wn2 (u - y) - 2 zeta wn y', |y'| limited, u within the
/// stops.
Eigen::Vector2d derivative(const ServoConfig& config, const ServoState& state, double command_rad);

/// Returns the state clamped to stops and rate limit, for use after an integration step.
ServoState within_limits(const ServoConfig& config, const ServoState& state);

}  // namespace hedgehop::dynamics::helicopter
