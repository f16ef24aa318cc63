#pragma once

#include "dynamics/controls.h"

namespace hedgehop::dynamics::helicopter {

/// The controls of a helicopter: commanded to the servos, or their positions.
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

}  // namespace hedgehop::dynamics::helicopter
