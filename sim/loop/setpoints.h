#pragma once

#include "avoidance/module.h"
#include "dynamics/avionics.h"

/// Where the loop translates between rooms that must not know each other.
namespace hedgehop::sim {

/// A module's command as the autopilot takes it.
dynamics::control::Setpoint to_setpoint(const avoidance::Command& command);
/// The navigation filter's estimate as a module sees it.
avoidance::NavigationState to_navigation_state(const dynamics::Avionics& avionics);

}  // namespace hedgehop::sim
