#pragma once

#include <Eigen/Core>
#include <string_view>
#include <variant>

#include "sim/fields/field.h"

/// Engine and governor of a helicopter, and the speed of its rotors.
namespace hedgehop::dynamics::helicopter {

struct ConstantSpeedConfig {
  static constexpr std::string_view kName = "constant";
  static constexpr std::string_view kMeaning = "constant rotor speed at unlimited power";
};
template <class Visitor>
void describe(Visitor&, const ConstantSpeedConfig&) {}

/// Defaults: the X-Cell .60 of [Gavrilets2015] table of parameters.
struct GovernedEngineConfig {
  static constexpr std::string_view kName = "governed";
  static constexpr std::string_view kMeaning = "engine of limited power with a governor";
  double max_power_w = 2000.0;
  double proportional_gain_sprad = 0.01;
  double integral_gain_prad = 0.02;
  double inertia_kgm2 = 0.095;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<GovernedEngineConfig> auto& c) {
  v("max_power", c.max_power_w, {.unit = "W", .above = 0.0, .meaning = "power at the rotor shaft with open throttle"});
  v("proportional_gain", c.proportional_gain_sprad,
    {.unit = "s/rad", .at_least = 0.0, .meaning = "throttle per speed error"});
  v("integral_gain", c.integral_gain_prad,
    {.unit = "1/rad", .at_least = 0.0, .meaning = "throttle per integral of the speed error"});
  v("inertia", c.inertia_kgm2,
    {.unit = "kg m2", .above = 0.0, .meaning = "inertia of all rotating parts, referred to the main rotor shaft"});
}
using RotorSpeedConfig = std::variant<ConstantSpeedConfig, GovernedEngineConfig>;

/// Minimum rotor speed of the rotor model, as a share of the set speed. Chosen: first-order flapping is not valid for
/// slower rotors.
inline constexpr double kMinRotorSpeed = 0.1;

struct RotorSpeedState {
  double speed_radps = 0.0;        ///< Omega of the main rotor
  double integral_throttle = 0.0;  ///< integral part of the governor's throttle
};

/// Returns the governor's throttle, 0 closed to 1 open. @param set_radps  set speed.
double throttle(const GovernedEngineConfig& engine, double set_radps, const RotorSpeedState& state);

/// Returns the time derivative of (speed, integral throttle). Inertia times acceleration is the engine's torque,
/// P_max throttle / Omega, minus that of the rotors. The integral is constant while the throttle saturates.
/// @param shaft_power_w  of main and tail rotor. Source: [Gavrilets2015] sec. on the engine, drive train and governor.
/// Differs: the body's yaw acceleration is neglected.
Eigen::Vector2d derivative(const GovernedEngineConfig& engine, double set_radps, const RotorSpeedState& state,
                           double shaft_power_w);

/// As derivative(), with the engine off: no torque drives the rotors, and the integral is constant.
Eigen::Vector2d coasting(const GovernedEngineConfig& engine, double set_radps, const RotorSpeedState& state,
                         double shaft_power_w);

}  // namespace hedgehop::dynamics::helicopter
