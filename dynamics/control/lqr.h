#pragma once

#include <Eigen/Core>

/// Linear-quadratic design for sampled systems of moderate size; matrices are on the stack.
namespace hedgehop::dynamics::control {

inline constexpr int kMaxStates = 32;
using DesignMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxStates, kMaxStates>;
using DesignVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxStates, 1>;

/// dx/dt = A x + B u, or x_next = A x + B u.
struct LinearSystem {
  DesignMatrix A, B;
};

/// Returns the exact sampled system for inputs held over steps of dt_s > 0.
LinearSystem sampled(const LinearSystem& continuous, double dt_s);

/// Returns K, inputs x states, such that u = -K x minimizes the sum of x'Qx + u'Ru over all steps of a sampled system.
/// @param Q, R  symmetric, Q at least semidefinite, R definite.
/// Throws std::invalid_argument if no such K stabilizes the system.
/// Source: structured doubling for the discrete algebraic Riccati equation [ChuFanLinWang2004] sec. 2.
DesignMatrix lqr_gain(const LinearSystem& system, const DesignMatrix& Q, const DesignMatrix& R);

}  // namespace hedgehop::dynamics::control
