#pragma once

#include <Eigen/Core>

#include "dynamics/actuators.h"
#include "dynamics/control/hover_model.h"
#include "dynamics/control/lqr.h"

namespace hedgehop::dynamics::control {

/// Turn at body rates, without any hold of attitude, velocity or altitude.
struct RateSetpoint {
  Eigen::Vector3d w_WB_B = Eigen::Vector3d::Zero();  ///< roll, pitch and yaw rate, rad/s
  /// Share of the range of the heave control, 0 .. 1: the thrust of a multicopter, the collective of a helicopter. As
  /// in MAVLink's SET_ATTITUDE_TARGET.
  double thrust = 0.0;
};

/// Holds a vehicle that has a hover model to body rates: a linear-quadratic design, with integrals, on the rates and
/// the hidden states of that model. Thrust is not controlled. Source: [BrysonHo1975] sec. 5.2, with weights as in
/// Autopilot.
class RateControl {
 public:
  /// @param dt_s  between two calls of control(), > 0. Throws std::invalid_argument if the rates cannot be stabilized.
  RateControl(const HoverModel& model, double dt_s);

  /// Returns the actuator commands for the next dt_s. @param w_WB_B_est  measured body rates, rad/s.
  Controls control(const RateSetpoint& setpoint, const Eigen::Vector3d& w_WB_B_est);

 private:
  static constexpr Eigen::Index kRates = 3, kTorques = 3;

  void solve_steady_turn(const LinearSystem& motion);

  double dt_s_;
  Controls trim_, lowest_, highest_;
  LinearSystem step_;                           ///< rates and hidden states, sampled
  DesignMatrix K_;                              ///< roll, pitch and yaw control x (rates, hidden states, integrals)
  DesignMatrix steady_hidden_, steady_torque_;  ///< of a steady turn, per body rate
  DesignVector hidden_;                         ///< predicted by the model
  Eigen::Vector3d integrals_ = Eigen::Vector3d::Zero();  ///< of the rates' errors, rad
};

}  // namespace hedgehop::dynamics::control
