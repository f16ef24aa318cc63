#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "dynamics/actuator_fault.h"
#include "dynamics/controls.h"
#include "dynamics/helicopter/helicopter_flight.h"
#include "dynamics/hull.h"
#include "dynamics/multicopter/multicopter_flight.h"
#include "dynamics/rigid_body.h"

namespace hedgehop::dynamics {

/// The vehicles that can fly; the YAML key `type` picks one.
using VehicleConfig = std::variant<helicopter::HelicopterConfig, multicopter::MulticopterConfig>;

/// Returns the convex pieces a vehicle is made of, in B. Throws std::invalid_argument when one has no size.
std::vector<HullPart> hull(const VehicleConfig& config);

/// One vehicle in flight, of any kind: fourth-order Runge-Kutta steps of a pure derivative.
class Vehicle {
 public:
  /// In a trimmed hover at W's origin until reset(). Throws std::invalid_argument on values that cannot be, or that
  /// cannot hover.
  explicit Vehicle(const VehicleConfig& config);

  /// Puts the vehicle into a trimmed hover over ground, servos included.
  /// @param p_WB  m. @param heading_rad  from north to east. @param wind_W  velocity of the air in W, m/s.
  /// Throws std::invalid_argument when the vehicle cannot hover there.
  void reset(const Eigen::Vector3d& p_WB, double heading_rad, const Eigen::Vector3d& wind_W);

  /// Moves on by dt; command and wind are held over the step. Allocates no memory.
  /// @param dt_s  > 0, at most 0.002 for vehicles of the default sizes (a helicopter's fastest motion decays at 40
  /// 1/s).
  void step(const Controls& command, const Eigen::Vector3d& wind_W, double dt_s);
  /// What ails its actuators from now on; reset() leaves it.
  void set_faults(std::span<const ActuatorFault> faults);

  const RigidBodyState& body() const;
  /// What an ideal accelerometer at B reads, in B, m/s2: (0, 0, -g) level at rest.
  const Eigen::Vector3d& specific_force_B() const;
  /// Where the actuators stand, in the vehicle's own units.
  Controls actuators() const;
  /// What its controls are, with their units as a table's head has them ("collective_rad").
  const std::array<std::string_view, kControlAxes>& control_names() const;
  /// False while a helicopter descends into its own wake, where its rotor model is not to be trusted.
  bool within_validity() const;

 private:
  std::variant<helicopter::HelicopterFlight, multicopter::MulticopterFlight> flight_;
};

}  // namespace hedgehop::dynamics
