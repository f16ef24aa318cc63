#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "dynamics/actuators.h"
#include "dynamics/helicopter/helicopter_flight.h"
#include "dynamics/hull.h"
#include "dynamics/multicopter/multicopter_flight.h"
#include "dynamics/rigid_body.h"

namespace hedgehop::dynamics {

/// Configuration of any vehicle. The YAML key `type` selects one.
using VehicleConfig = std::variant<helicopter::HelicopterConfig, multicopter::MulticopterConfig>;

/// Returns the convex parts of a vehicle, in B. Throws std::invalid_argument if a part has no size.
std::vector<HullPart> hull(const VehicleConfig& config);

/// Commands to the actuators: of an autopilot of ours, or the speed of each rotor of a multicopter, rad/s.
using ActuatorCommand = std::variant<Controls, multicopter::PerRotor>;

/// One vehicle of any kind in flight, integrated by fourth-order Runge-Kutta steps.
class Vehicle {
 public:
  /// Starts in a trimmed hover at W's origin. Throws std::invalid_argument if values are out of range or the vehicle
  /// cannot hover.
  explicit Vehicle(const VehicleConfig& config);

  /// Puts the vehicle, with its servos, into a trimmed hover relative to the ground.
  /// @param p_WB  m. @param heading_rad  from north to east. @param wind_W  velocity of the air in W, m/s.
  /// Throws std::invalid_argument if the vehicle cannot hover in this wind.
  void reset(const Eigen::Vector3d& p_WB, double heading_rad, const Eigen::Vector3d& wind_W);

  /// Advances by dt; command and wind are constant during the step. Allocates no memory. Throws std::invalid_argument
  /// for rotor speeds of another number than the vehicle's rotors.
  /// @param dt_s  > 0, at most 0.002 for vehicles of the default sizes (a helicopter's fastest motion decays at 40
  /// 1/s).
  void step(const Controls& command, const Eigen::Vector3d& wind_W, double dt_s);
  void step(const ActuatorCommand& command, const Eigen::Vector3d& wind_W, double dt_s);
  /// Puts the vehicle at rest on a stand, with its rotors stopped (a helicopter with constant rotor speed: at flat
  /// pitch). @param p_WB  m. @param heading_rad  from north to east.
  void reset_on_stand(const Eigen::Vector3d& p_WB, double heading_rad, const Eigen::Vector3d& wind_W);
  /// As step(), but the stand holds the pose; only rotors and servos move. @return whether the thrust exceeds the
  /// weight after the step.
  bool step_on_stand(const ActuatorCommand& command, const Eigen::Vector3d& wind_W, double dt_s);
  /// Replaces pose and velocities; rotors and servos keep their state.
  void set_body(const RigidBodyState& body, const Eigen::Vector3d& wind_W);
  /// Switches the engine of a helicopter with a governor from now on; reset() and reset_on_stand() switch it on. Has no
  /// effect on other vehicles.
  void set_engine(bool on);
  /// Sets the actuators' faults from now on; reset() keeps them.
  void set_faults(std::span<const ActuatorFault> faults);

  const RigidBodyState& body() const;
  /// Specific force at B, in B, m/s2: (0, 0, -g) level at rest.
  const Eigen::Vector3d& specific_force_B() const;
  /// Actuator positions, in the vehicle's units.
  Controls actuators() const;
  /// Names of the controls with their units, as in table headings ("collective_rad").
  const std::array<std::string_view, kControlAxes>& control_names() const;
  /// False while a helicopter descends into its own wake, outside the range of its rotor model.
  bool within_validity() const;

 private:
  std::variant<helicopter::HelicopterFlight, multicopter::MulticopterFlight> flight_;
};

}  // namespace hedgehop::dynamics
