#pragma once

#include <variant>

#include "avoidance/module.h"
#include "dynamics/control/autopilot.h"
#include "dynamics/control/rate_control.h"
#include "dynamics/vehicle.h"

namespace hedgehop::sim {

/// A command below the autopilot's setpoints, for callers of a simulation: body rates with thrust, or the speed of each
/// rotor of a multicopter in the order of its arms, rad/s. Avoidance modules cannot give it.
using DirectCommand = std::variant<dynamics::control::RateSetpoint, dynamics::multicopter::PerRotor>;

/// A command that replaces the module's decision.
using CallerCommand = std::variant<avoidance::Command, DirectCommand>;

/// The input of the aircraft: a setpoint of the autopilot, or a direct command.
using Steering = std::variant<dynamics::control::Setpoint, DirectCommand>;

/// Maximum of each commanded body rate: two turns per second.
inline constexpr double kMaxBodyRateRadps = 12.566370614359172;

/// Throws std::invalid_argument, with the valid values, unless rates are finite and at most kMaxBodyRateRadps, thrust
/// is in 0 .. 1, and there is one speed for each rotor, in 0 .. the highest of the vehicle.
void require_valid(const DirectCommand& command, const dynamics::VehicleConfig& vehicle);

/// The direct commands of a hover in still air.
struct DirectHover {
  double thrust = 0.0;                           ///< as of RateSetpoint
  dynamics::multicopter::PerRotor speeds_radps;  ///< of the rotors; empty for a helicopter
  double highest_radps = 0.0;                    ///< maximum speed of a rotor; 0 for a helicopter
};
/// Throws std::invalid_argument if the vehicle cannot hover.
DirectHover direct_hover(const dynamics::VehicleConfig& vehicle);

}  // namespace hedgehop::sim
