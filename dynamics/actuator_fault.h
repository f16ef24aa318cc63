#pragma once

#include <cstddef>

namespace hedgehop::dynamics {

/// What ails one motor of a multicopter or one servo of a helicopter.
struct ActuatorFault {
  enum class Kind {
    stuck,   ///< stays as it is: a rotor's speed, a servo's position
    scaled,  ///< follows `value` times its command
    offset   ///< follows its command plus `value`, rad: a slipped linkage
  };
  size_t actuator = 0;  ///< in the order of the arms, or of BladeAngles
  Kind kind = Kind::stuck;
  double value = 0.0;
};

/// What the actuator follows instead of its command. @param now  where it stands.
inline double followed(const ActuatorFault& fault, double command, double now) {
  if (fault.kind == ActuatorFault::Kind::stuck) return now;
  return fault.kind == ActuatorFault::Kind::scaled ? fault.value * command : command + fault.value;
}

}  // namespace hedgehop::dynamics
