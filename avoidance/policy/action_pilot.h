#pragma once

#include <Eigen/Core>

#include "avoidance/module.h"

/// The interface of a learned policy: its state input and its actions. ONNX files and hedgehop.Env in Python share this
/// convention, so a policy that was trained in one runs in the other.
namespace hedgehop::avoidance::policy {

/// State input: goal forward, right and down of the vehicle in H (heading.h), m; velocity in B, m/s; roll and pitch,
/// rad; yaw rate, rad/s; height above ground, m. All values are onboard estimates.
/// @param navigation  its attitude has length 1 and does not point straight up or down.
using State = Eigen::Matrix<float, 10, 1>;
State state_of(const NavigationState& navigation, const Goal& goal);

/// Forward, right, climb and turn, each in [-1, 1]: fractions of the speed limit (forward and right), of kClimbMps and
/// of kTurnRadps.
using Action = Eigen::Vector4d;

/// Converts actions to commands. The altitude and heading to hold change at the rates of the actions. They are limited
/// to a small lead over the vehicle, which would otherwise continue after the action ends.
class ActionPilot {
 public:
  static constexpr double kClimbMps = 1.0, kTurnRadps = 1.0;
  static constexpr double kAheadM = 3.0, kAheadRad = 1.5;

  /// Starts with the current altitude and heading.
  explicit ActionPilot(const NavigationState& navigation);

  /// @param action  clamped to [-1, 1].  @param speed_limit_mps  > 0.  @param step_s  duration of the action, > 0.
  VelocityCommand fly(const Action& action, const NavigationState& navigation, double speed_limit_mps, double step_s);

 private:
  double altitude_m_, heading_rad_;
};

}  // namespace hedgehop::avoidance::policy
