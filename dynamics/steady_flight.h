#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/control/lqr.h"
#include "dynamics/controls.h"
#include "dynamics/vehicle.h"

/// Steady flight of any vehicle and its motion near it, for people who study vehicles.
namespace hedgehop::dynamics {

/// A number with its name in the field's notation and its unit ("theta_c", "deg").
struct Quantity {
  std::string name, unit;
  double value = 0.0;
  std::string group, meaning;  ///< in words: what it belongs to ("Blade angles"), and which of these it is
};

/// Level flight without rotation that nothing changes but the position.
struct SteadyFlight {
  double roll_rad = 0.0, pitch_rad = 0.0;
  std::vector<Quantity> quantities;  ///< attitude, controls, rotors; the same ones in the same order for one vehicle
};
/// Returns the trim of level flight, or nothing where there is none. @param v_air_W  velocity through the air in W,
/// m/s; the heading is north. Throws std::invalid_argument on a vehicle that cannot be.
std::optional<SteadyFlight> steady_flight(const VehicleConfig& vehicle, const Eigen::Vector3d& v_air_W);

/// dx/dt = A x + B u about a trim, deviations from it. Actuators: a multicopter's motors are part of the states, a
/// helicopter's servos are not.
struct NamedLinearSystem {
  std::vector<std::string> states, inputs;  ///< names, with units where they are not SI
  control::LinearSystem system;
};
/// Returns the linear model of level flight at `v_air_W`, or nothing where there is no trim. Throws as steady_flight().
std::optional<NamedLinearSystem> linear_system(const VehicleConfig& vehicle, const Eigen::Vector3d& v_air_W);

/// One mode of motion: a real eigenvalue, or a pair of conjugates (the one with positive imaginary part stands for it).
struct Mode {
  std::complex<double> eigenvalue;  ///< rad/s
  double frequency_radps = 0.0;     ///< its magnitude
  double damping = 0.0;             ///< -Re / magnitude; below 0 it grows
};
/// Returns the modes of dx/dt = A x, slowest first.
std::vector<Mode> modes(const control::DesignMatrix& A);

}  // namespace hedgehop::dynamics
