#pragma once

#include <Eigen/Core>
#include <array>

#include "dynamics/control/lqr.h"
#include "dynamics/controls.h"
#include "dynamics/vehicle.h"

namespace hedgehop::dynamics::control {

/// A vehicle's motion near its hover in still air, actuators included: what an autopilot is designed on.
/// dx/dt = A x + B u, in deviations from the trim; u are the Controls.
struct HoverModel {
  /// Velocity over ground forward, right, down in the level frame that turns with the heading (m/s); roll, pitch,
  /// heading (rad); p, q, r (rad/s); distance below the set altitude (m). Then come the states that no sensor
  /// measures: disc, stabilizer bar, servos.
  enum State { kForward, kRight, kDown, kRoll, kPitch, kHeading, kP, kQ, kR, kBelow, kHidden };
  LinearSystem motion;
  double roll_rad = 0.0, pitch_rad = 0.0;  ///< of the trim
  Controls trim, lowest, highest;
  Controls acceptable;  ///< deviations that cost the actuators alike: the scale of a design's weights
};

/// Throws std::invalid_argument when the vehicle has no hover.
HoverModel make_hover_model(const VehicleConfig& vehicle);

}  // namespace hedgehop::dynamics::control
