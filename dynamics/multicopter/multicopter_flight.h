#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "dynamics/actuators.h"
#include "dynamics/multicopter/multicopter.h"

namespace hedgehop::dynamics::multicopter {

struct MulticopterFlightState {
  RigidBodyState body;
  PerRotor speeds_radps;
};

/// Steady flight of a multicopter: only the position changes.
struct MulticopterTrim {
  MulticopterFlightState state;  ///< position zero; the velocity is relative to the air
  double roll_rad = 0.0, pitch_rad = 0.0;
};
/// Returns the trim of straight flight without rotation; nullopt if Newton's method finds none within the limits of the
/// rotors. @param v_air_W  velocity relative to the air in W, m/s. @param heading_rad  from north to east.
std::optional<MulticopterTrim> trim(const MulticopterModel& model, const Eigen::Vector3d& v_air_W,
                                    double heading_rad = 0.0);

/// Motion near a trim: dx/dt = A x + B u, in deviations from the trim. u are the commanded thrust and torques. The time
/// constant of the motors is the mean of those for rising and falling speed.
struct MulticopterLinearModel {
  /// u, v, w (m/s, in B), p, q, r, roll, pitch, heading, then thrust and torques of the rotors (N, N m).
  enum State {
    kU,
    kV,
    kW,
    kP,
    kQ,
    kR,
    kRollAngle,
    kPitchAngle,
    kHeading,
    kThrust,
    kRollTorque,
    kPitchTorque,
    kYawTorque,
    kStates
  };
  Eigen::Matrix<double, kStates, kStates> A;
  Eigen::Matrix<double, kStates, kControlAxes> B;
};
/// Returns the linear model about a trim: central differences for the airframe, closed form for the motors.
MulticopterLinearModel linearize(const MulticopterModel& model, const MulticopterTrim& trim);

/// A multicopter in flight: constant model, explicit state. Motors are integrated exactly, the body by Runge-Kutta.
class MulticopterFlight {
 public:
  static constexpr std::array<std::string_view, kControlAxes> kControlNames = {"thrust_n", "roll_torque_nm",
                                                                               "pitch_torque_nm", "yaw_torque_nm"};
  /// Throws std::invalid_argument if a value is invalid.
  explicit MulticopterFlight(const MulticopterConfig& config);

  // As in Vehicle.
  void reset(const Eigen::Vector3d& p_WB, double heading_rad, const Eigen::Vector3d& wind_W);
  void reset_on_stand(const Eigen::Vector3d& p_WB, double heading_rad, const Eigen::Vector3d& wind_W);
  void step_controls(const Controls& command, const Eigen::Vector3d& wind_W, double dt_s) {
    step_rotors(allocate(model_, command), wind_W, dt_s);
  }
  void set_faults(std::span<const ActuatorFault> faults) { faults_.assign(faults.begin(), faults.end()); }
  const RigidBodyState& body() const { return state_.body; }
  const Eigen::Vector3d& specific_force_B() const { return specific_force_B_; }
  Controls controls() const { return wrench(model_, state_.speeds_radps); }
  bool within_validity() const { return true; }  // the rotor model has no wake

  const MulticopterModel& model() const { return model_; }
  const MulticopterFlightState& state() const { return state_; }
  /// Advances with commanded rotor speeds, rad/s, and the faults of the motors. Parameters as Vehicle::step().
  void step_rotors(PerRotor commanded_radps, const Eigen::Vector3d& wind_W, double dt_s);
  /// As step_rotors(), without faults.
  void step(const PerRotor& commanded_radps, const Eigen::Vector3d& wind_W, double dt_s);
  /// Sets the state. @param wind_W  velocity of the air in W at this instant, m/s.
  void set_state(const MulticopterFlightState& state, const Eigen::Vector3d& wind_W);

 private:
  MulticopterModel model_;
  MulticopterFlightState state_;
  std::vector<ActuatorFault> faults_;
  Eigen::Vector3d specific_force_B_ = Eigen::Vector3d::Zero();
};

}  // namespace hedgehop::dynamics::multicopter
