#pragma once

namespace hedgehop::dynamics {

/// Blade angles of a helicopter: what the autopilot asks of the servos, or where the servos stand.
struct ActuatorCommand {
  double collective_rad = 0.0;    ///< main rotor, at 3/4 radius; positive climbs
  double lateral_rad = 0.0;       ///< cyclic; positive tilts the disc right and rolls right
  double longitudinal_rad = 0.0;  ///< cyclic; positive tilts the disc back and pitches up
  double tail_rad = 0.0;          ///< tail rotor collective, at 3/4 radius; positive opposes the main rotor's torque
};

}  // namespace hedgehop::dynamics
