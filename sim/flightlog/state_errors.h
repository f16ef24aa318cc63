#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string_view>

#include "dynamics/rigid_body.h"

namespace hedgehop::sim {

/// Difference of two states: position north, east, down (m); velocity along the measured body axes (m/s); roll, pitch,
/// yaw (rad); p, q, r (rad/s).
using StateError = Eigen::Matrix<double, 12, 1>;

/// Names and units of its components. Each group has three.
inline constexpr std::array<std::string_view, 12> kStateNames = {"north", "east",  "down", "u", "v", "w",
                                                                 "phi",   "theta", "psi",  "p", "q", "r"};
inline constexpr std::array<std::string_view, 4> kStateGroups = {"position", "velocity", "attitude", "rates"};
inline constexpr std::array<std::string_view, 4> kGroupUnits = {"m", "m/s", "deg", "deg/s"};
inline constexpr Eigen::Index kPerGroup = 3;

/// Returns the error of a predicted state.
StateError state_error(const dynamics::RigidBodyState& predicted, const dynamics::RigidBodyState& measured);

/// Returns the state after `time_s` of constant velocity in W and constant rates in B.
dynamics::RigidBodyState at_constant_velocity(const dynamics::RigidBodyState& state, double time_s);

/// Root mean square of errors, per component.
class MeanSquares {
 public:
  void add(const StateError& error) {
    sum_ += error.cwiseAbs2();
    ++count_;
  }
  size_t count() const { return count_; }
  /// Returns the RMSE per component; NaN without errors.
  StateError rmse() const { return (sum_ / static_cast<double>(count_)).cwiseSqrt(); }

 private:
  StateError sum_ = StateError::Zero();
  size_t count_ = 0;
};

/// Returns the norm of each group of three components.
Eigen::Vector4d group_norms(const StateError& rmse);

}  // namespace hedgehop::sim
