#pragma once

#include <Eigen/Core>

namespace hedgehop::dynamics {

/// What an autopilot commands of a vehicle of any kind, one number for each motion; the unit is the vehicle's
/// own: blade angles of a helicopter (rad), thrust and torques of a multicopter (N, N m). Positive climbs, rolls right
/// and pitches up; positive yaw turns right.
using Controls = Eigen::Vector4d;
/// Index of a control. Angles, rates and torques have names of their own (kRollAngle, kP, kRollTorque).
enum ControlAxis : Eigen::Index { kHeave, kRoll, kPitch, kYaw, kControlAxes };

}  // namespace hedgehop::dynamics
