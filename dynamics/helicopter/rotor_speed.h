#pragma once

#include <Eigen/Core>
#include <string_view>
#include <variant>

#include "sim/fields/field.h"

/// What turns a helicopter's rotors, and how well it holds their speed.
namespace hedgehop::dynamics::helicopter {

struct ConstantSpeedConfig {
  static constexpr std::string_view kName = "constant";
  static constexpr std::string_view kMeaning = "held without fail, whatever power it takes";
};
template <class Visitor>
void describe(Visitor&, const ConstantSpeedConfig&) {}

/// Defaults: the X-Cell .60 of [Gavrilets2015] table of parameters.
struct GovernedEngineConfig {
  static constexpr std::string_view kName = "governed";
  static constexpr std::string_view kMeaning = "engine of limited power behind a governor";
  double max_power_w = 2000.0;
  double proportional_gain_sprad = 0.01;
  double integral_gain_prad = 0.02;
  double inertia_kgm2 = 0.095;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<GovernedEngineConfig> auto& c) {
  v("max_power", c.max_power_w, {.unit = "W", .above = 0.0, .meaning = "at the rotor's shaft, throttle open"});
  v("proportional_gain", c.proportional_gain_sprad,
    {.unit = "s/rad", .at_least = 0.0, .meaning = "throttle per speed that is missing"});
  v("integral_gain", c.integral_gain_prad,
    {.unit = "1/rad", .at_least = 0.0, .meaning = "throttle per angle that has been missed"});
  v("inertia", c.inertia_kgm2,
    {.unit = "kg m2", .above = 0.0, .meaning = "of all that rotates, reflected to the main rotor's shaft"});
}
using RotorSpeedConfig = std::variant<ConstantSpeedConfig, GovernedEngineConfig>;

/// As a share of the set speed: slower rotors are computed at this speed. Chosen: a rotor that hardly turns has no
/// first-order flapping.
inline constexpr double kSlowestRotor = 0.1;

struct RotorSpeedState {
  double speed_radps = 0.0;        ///< Omega of the main rotor
  double integral_throttle = 0.0;  ///< what the governor's integral adds to the throttle
};

/// Returns the governor's throttle, 0 closed to 1 open. @param set_radps  the speed it is to hold.
double throttle(const GovernedEngineConfig& engine, double set_radps, const RotorSpeedState& state);

/// Returns the time derivative of (speed, integral throttle): inertia times acceleration is the engine's torque
/// P_max throttle / Omega less that of the rotors; the integral rests while the throttle is at a stop that it pushes
/// on.
/// @param shaft_power_w  of main and tail rotor. Source: [Gavrilets2015] sec. on the engine, drive train and governor.
/// Differs: the body's yaw acceleration is left out.
Eigen::Vector2d derivative(const GovernedEngineConfig& engine, double set_radps, const RotorSpeedState& state,
                           double shaft_power_w);

}  // namespace hedgehop::dynamics::helicopter
