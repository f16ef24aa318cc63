#pragma once

#include <Eigen/Core>

#include "avoidance/module.h"

/// How a learned policy is joined to an aircraft: what it is told besides images, and how its actions are flown. One
/// convention for ONNX files and for Python's hedgehop.Env, so that what was trained in the one flies in the other.
namespace hedgehop::avoidance::policy {

/// The goal forward, right and down of the vehicle in H (heading.h), m; velocity in B, m/s; roll, pitch, rad; yaw rate,
/// rad/s; height above ground, m. All as estimated on board.
/// @param navigation  its attitude of length 1, not pointing straight up or down.
using State = Eigen::Matrix<float, 10, 1>;
State state_of(const NavigationState& navigation, const Goal& goal);

/// Forward, right, climb, turn, each in [-1, 1]: shares of the speed limit twice, of kClimbMps, of kTurnRadps.
using Action = Eigen::Vector4d;

/// Turns actions into commands. The height and the heading to hold move at the rates that the actions name, but never
/// far ahead of the vehicle, which would go on where they stop.
class ActionPilot {
 public:
  static constexpr double kClimbMps = 1.0, kTurnRadps = 1.0;
  static constexpr double kAheadM = 3.0, kAheadRad = 1.5;

  /// Begins with the height and heading of now.
  explicit ActionPilot(const NavigationState& navigation);

  /// @param action  confined to [-1, 1].  @param speed_limit_mps  > 0.  @param step_s  that the action is for, > 0.
  VelocityCommand fly(const Action& action, const NavigationState& navigation, double speed_limit_mps, double step_s);

 private:
  double altitude_m_, heading_rad_;
};

}  // namespace hedgehop::avoidance::policy
