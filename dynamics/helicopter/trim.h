#pragma once

#include <Eigen/Core>
#include <optional>

#include "dynamics/helicopter/helicopter.h"

namespace hedgehop::dynamics::helicopter {

/// Steady flight: nothing changes but the position.
struct Trim {
  HelicopterState state;  ///< position zero; velocity is that through the air
  BladeAngles blades;
  double roll_rad = 0.0, pitch_rad = 0.0;
  HelicopterLoads loads;
};

/// Returns the trim of straight flight without rotation, or nothing when Newton's method finds none.
/// @param v_air_W      velocity through the air in W, m/s; zero is a hover in still air, minus the wind one in wind.
/// @param heading_rad  from north to east.
std::optional<Trim> trim(const HelicopterModel& model, const Eigen::Vector3d& v_air_W, double heading_rad = 0.0);

/// Motion near a trim: dx/dt = A x + B u, deviations from the trim.
struct LinearModel {
  /// u, v, w (m/s, in B), p, q, r, roll, pitch, heading, disc back, disc right, bar back, bar right (rad, rad/s).
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
    kDiscBack,
    kDiscRight,
    kBarBack,
    kBarRight,
    kStates
  };
  /// In the order of BladeAngles, rad.
  enum Input { kCollective, kLateral, kLongitudinal, kTail, kInputs };
  Eigen::Matrix<double, kStates, kStates> A;  ///< rows and columns of the bar are zero when it is lumped
  Eigen::Matrix<double, kStates, kInputs> B;
};

/// Returns the linear model by central differences about a trim; servos are not part of it.
LinearModel linearize(const HelicopterModel& model, const Trim& trim);

}  // namespace hedgehop::dynamics::helicopter
