#pragma once

#include <cstdint>
#include <vector>

#include "sim/config/input_error.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// Range of the physics rate that a scenario gets if it states none, Hz. The minimum of a linked flight is higher,
/// because autopilots sample their IMU at 1000 Hz.
inline constexpr int64_t kMinChosenPhysicsHz = 500, kMinLinkedPhysicsHz = 1000, kMaxChosenPhysicsHz = 2000;

/// Sets Scenario::physics_rate_hz, if the scenario states none, to the smallest rate in the range that the control rate
/// and the rates of all sensors and cameras divide. The film is no input of the flight and has no influence.
/// @return one error for each rate that does not divide the physics rate, with the nearest rates that do.
std::vector<FieldError> set_physics_rate(Scenario& scenario);

}  // namespace hedgehop::sim
