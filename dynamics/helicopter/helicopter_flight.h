#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "dynamics/actuators.h"
#include "dynamics/helicopter/blade_servos.h"
#include "dynamics/helicopter/helicopter.h"

namespace hedgehop::dynamics::helicopter {

/// State of airframe, servos (in the order of BladeAngles) and rotor speed.
struct HelicopterFlightState {
  HelicopterState airframe;
  std::array<ServoState, 4> servos;
  RotorSpeedState rotor;
};

/// A helicopter in flight: constant model, explicit state.
class HelicopterFlight {
 public:
  /// Throws std::invalid_argument if a value is invalid.
  explicit HelicopterFlight(const HelicopterConfig& config);

  static constexpr std::array<std::string_view, kControlAxes> kControlNames = {"collective_rad", "lateral_rad",
                                                                               "longitudinal_rad", "tail_rad"};
  // As in Vehicle.
  void reset(const Eigen::Vector3d& p_WB, double heading_rad, const Eigen::Vector3d& wind_W);
  void reset_on_stand(const Eigen::Vector3d& p_WB, double heading_rad, const Eigen::Vector3d& wind_W);
  void set_engine(bool on) { engine_on_ = on; }
  void step(const BladeAngles& command, const Eigen::Vector3d& wind_W, double dt_s);
  void set_faults(std::span<const ActuatorFault> faults) { faults_.assign(faults.begin(), faults.end()); }
  const RigidBodyState& body() const { return state_.airframe.body; }
  const Eigen::Vector3d& specific_force_B() const { return specific_force_B_; }
  void step_controls(const Controls& command, const Eigen::Vector3d& wind_W, double dt_s) {
    step(to_blade_angles(command), wind_W, dt_s);
  }
  BladeAngles actuators() const;
  Controls controls() const { return to_controls(actuators()); }
  bool within_validity() const { return within_validity_; }

  const HelicopterModel& model() const { return model_; }
  const HelicopterFlightState& state() const { return state_; }
  /// Sets the state. @param wind_W  velocity of the air in W at this instant, m/s.
  void set_state(const HelicopterFlightState& state, const Eigen::Vector3d& wind_W);

 private:
  HelicopterModel model_at(const RotorSpeedState& rotor) const {
    return engine_ ? at_speed(model_, rotor.speed_radps) : model_;
  }

  HelicopterModel model_;
  std::array<ServoConfig, 4> servos_;
  HelicopterFlightState state_;
  std::vector<ActuatorFault> faults_;
  Eigen::Vector3d specific_force_B_ = Eigen::Vector3d::Zero();
  bool within_validity_ = true;
  std::optional<GovernedEngineConfig> engine_;  ///< nullopt if the rotor speed is constant
  bool engine_on_ = true;
};

}  // namespace hedgehop::dynamics::helicopter
