#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/actuators.h"
#include "dynamics/control/lqr.h"
#include "dynamics/vehicle.h"

/// Trim, linear model and modes of any vehicle, for the study of vehicles.
namespace hedgehop::dynamics {

/// Number with its symbol and unit ("theta_c", "deg").
struct Quantity {
  std::string name, unit;
  double value = 0.0;
  std::string group, meaning;  ///< in words: its group ("Blade angles") and its name in that group
};

/// Level flight without rotation, in which only the position changes.
struct SteadyFlight {
  double roll_rad = 0.0, pitch_rad = 0.0;
  std::vector<Quantity> quantities;  ///< attitude, controls, rotors; in one order per vehicle type
};
/// Returns the trim of level flight with heading north; nullopt if there is none. @param v_air_W  velocity relative to
/// the air in W, m/s. Throws std::invalid_argument if the vehicle is invalid.
std::optional<SteadyFlight> steady_flight(const VehicleConfig& vehicle, const Eigen::Vector3d& v_air_W);

/// dx/dt = A x + B u, in deviations from a trim. The states include a multicopter's motors, but not a helicopter's
/// servos.
struct NamedLinearSystem {
  std::vector<std::string> states, inputs;  ///< names, with units that are not SI
  control::LinearSystem system;
};
/// Returns the linear model of level flight at `v_air_W`; nullopt if there is no trim. Throws as steady_flight().
std::optional<NamedLinearSystem> linear_system(const VehicleConfig& vehicle, const Eigen::Vector3d& v_air_W);

/// Mode of motion: a real eigenvalue, or a pair of conjugates (given by the one with positive imaginary part).
struct Mode {
  std::complex<double> eigenvalue;  ///< rad/s
  double frequency_radps = 0.0;     ///< its magnitude
  double damping = 0.0;             ///< -Re / magnitude; < 0 for a growing mode
};
/// Returns the modes of dx/dt = A x, slowest first.
std::vector<Mode> modes(const control::DesignMatrix& A);

}  // namespace hedgehop::dynamics
