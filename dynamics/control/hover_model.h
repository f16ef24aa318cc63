#pragma once

#include <Eigen/Core>
#include <array>

#include "dynamics/actuators.h"
#include "dynamics/control/lqr.h"
#include "dynamics/vehicle.h"

namespace hedgehop::dynamics::control {

/// Linear model of a vehicle and its actuators near its hover in still air, for the design of an autopilot:
/// dx/dt = A x + B u, in deviations from the trim. u are the Controls.
struct HoverModel {
  /// Velocity over ground forward, right, down in the level frame that turns with the heading (m/s); roll, pitch,
  /// heading (rad); p, q, r (rad/s); distance below the set altitude (m). The states that no sensor measures follow:
  /// disc, stabilizer bar, servos.
  enum State { kForward, kRight, kDown, kRollAngle, kPitchAngle, kHeading, kP, kQ, kR, kBelow, kHidden };
  LinearSystem motion;
  double roll_rad = 0.0, pitch_rad = 0.0;  ///< of the trim
  Controls trim, lowest, highest;
  Controls acceptable;  ///< deviations of equal cost, which scale the weights of a design
};

/// Throws std::invalid_argument if the vehicle cannot hover.
HoverModel make_hover_model(const VehicleConfig& vehicle);

}  // namespace hedgehop::dynamics::control
