#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/actuators.h"
#include "dynamics/control/lqr.h"
#include "dynamics/vehicle.h"

/// Trim and linear model of any vehicle, for the study of vehicles.
namespace hedgehop::dynamics {

/// Number with its symbol and unit ("theta_c", "deg"), and the stops of a control or the limits of a rotor or engine.
struct Quantity {
  std::string name, unit;
  double value = 0.0;
  std::string group, meaning;  ///< in words: its group ("Main collective") and its name in that group
  std::optional<double> lowest = {}, highest = {};

  bool has_limit() const { return lowest || highest; }
  /// Returns the distance to the nearer limit in percent: of the travel between two stops, else of the one limit.
  /// Negative beyond it. Requires a limit other than 0.
  double margin_percent() const;
  /// Returns "theta_c 29.8 deg, limit 18 deg"; nullopt within the limits.
  std::optional<std::string> beyond() const;
};

/// Level flight without rotation, in which only the position changes.
struct SteadyFlight {
  double roll_rad = 0.0, pitch_rad = 0.0;
  std::vector<Quantity> quantities;  ///< attitude, controls, rotors; in one order per vehicle type

  /// Returns the quantities beyond their limits, each as Quantity::beyond(). The vehicle cannot fly such a trim.
  std::vector<std::string> beyond() const;
};
/// Returns the trim of level flight with heading north, within or beyond the limits of its controls; nullopt if there
/// is none. @param v_air_W  velocity relative to the air in W, m/s. Throws std::invalid_argument if the vehicle is
/// invalid.
std::optional<SteadyFlight> steady_flight(const VehicleConfig& vehicle, const Eigen::Vector3d& v_air_W);

/// dx/dt = A x + B u, in deviations from a trim. The states include a multicopter's motors, but not a helicopter's
/// servos.
struct NamedLinearSystem {
  std::vector<std::string> states, inputs;  ///< names
  std::vector<std::string> state_units, input_units;
  control::LinearSystem system;
};
/// Returns the linear model of level flight at `v_air_W`; nullopt if there is no trim. Throws as steady_flight().
std::optional<NamedLinearSystem> linear_system(const VehicleConfig& vehicle, const Eigen::Vector3d& v_air_W);

}  // namespace hedgehop::dynamics
