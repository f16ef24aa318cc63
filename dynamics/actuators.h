#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace hedgehop::dynamics {

/// Actuator commands or positions of any vehicle, one number per motion. The unit depends on the vehicle: blade angles
/// of a helicopter (rad), thrust and torques of a multicopter (N, N m). Positive heave climbs, positive roll is to the
/// right, positive pitch is nose up, positive yaw is to the right.
using Controls = Eigen::Vector4d;
/// Index of a control. Angles, rates and torques have names of their own (kRollAngle, kP, kRollTorque).
enum ControlAxis : Eigen::Index { kHeave, kRoll, kPitch, kYaw, kControlAxes };

/// Fault of one motor of a multicopter or one servo of a helicopter.
struct ActuatorFault {
  enum class Kind {
    stuck,   ///< keeps its rotor speed or servo position
    scaled,  ///< follows `value` times its command
    offset   ///< follows its command plus `value`, rad: a slipped linkage
  };
  size_t actuator = 0;  ///< in the order of the arms, or of BladeAngles
  Kind kind = Kind::stuck;
  double value = 0.0;
};

/// Returns the effective command of a faulty actuator. @param position  present position or speed.
inline double faulty_command(const ActuatorFault& fault, double command, double position) {
  if (fault.kind == ActuatorFault::Kind::stuck) return position;
  return fault.kind == ActuatorFault::Kind::scaled ? fault.value * command : command + fault.value;
}

}  // namespace hedgehop::dynamics
