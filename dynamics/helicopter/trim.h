#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "dynamics/helicopter/helicopter.h"

/// Trims and linear models of helicopters.
namespace hedgehop::dynamics::helicopter {

/// Steady flight: only the position changes.
struct Trim {
  HelicopterState state;  ///< position zero; the velocity is relative to the air
  BladeAngles blades;
  double roll_rad = 0.0, pitch_rad = 0.0;
  HelicopterLoads loads;
};

/// Motion near a trim: dx/dt = A x + B u, in deviations from the trim.
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
  Eigen::Matrix<double, kStates, kStates> A;  ///< the bar's rows and columns are zero if the bar is lumped
  Eigen::Matrix<double, kStates, kInputs> B;
};

/// The part of a helicopter model that trim and linearization use.
struct Airframe {
  MassProperties mass;
  FlappingModel flapping;
  /// Returns the loads in still air. Pure.
  std::function<HelicopterLoads(const HelicopterState& state, const BladeAngles& blades)> loads;
};
/// @param model  HelicopterModel, or any model with `mass`, `main_rotor` and an overload of helicopter_loads(). It must
/// outlive the airframe.
template <class Model>
Airframe airframe(const Model& model) {
  return {model.mass, model.main_rotor.flapping, [&model](const HelicopterState& state, const BladeAngles& blades) {
            return helicopter_loads(model, state, blades, Eigen::Vector3d::Zero());
          }};
}

/// Returns the trim of straight flight without rotation; nullopt if Newton's method finds none.
/// @param v_air_W      velocity relative to the air in W, m/s. In a hover it is minus the wind.
/// @param heading_rad  from north to east.
std::optional<Trim> trim(const Airframe& airframe, const Eigen::Vector3d& v_air_W, double heading_rad = 0.0);
inline std::optional<Trim> trim(const HelicopterModel& model, const Eigen::Vector3d& v_air_W,
                                double heading_rad = 0.0) {
  return trim(airframe(model), v_air_W, heading_rad);
}

/// Returns the linear model about a trim, by central differences. It does not include the servos.
LinearModel linearize(const Airframe& airframe, const Trim& trim);
inline LinearModel linearize(const HelicopterModel& model, const Trim& trim) {
  return linearize(airframe(model), trim);
}

}  // namespace hedgehop::dynamics::helicopter
