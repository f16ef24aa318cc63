#pragma once

#include <Eigen/Core>

namespace hedgehop::dynamics {

/// Returns x one step later by the classical fourth-order Runge-Kutta method.
/// @param t_s, h_s  time of x and step.
/// @param rate      pure, `Vector rate(double t_s, const Vector& x)`.
/// Source: [HairerNorsettWanner1993] sec. II.1.
template <int N, class Rate>
Eigen::Matrix<double, N, 1> rk4_step(const Eigen::Matrix<double, N, 1>& x, double t_s, double h_s, const Rate& rate) {
  using Vector = Eigen::Matrix<double, N, 1>;
  const Vector k1 = rate(t_s, x);
  const Vector k2 = rate(t_s + 0.5 * h_s, Vector(x + 0.5 * h_s * k1));
  const Vector k3 = rate(t_s + 0.5 * h_s, Vector(x + 0.5 * h_s * k2));
  const Vector k4 = rate(t_s + h_s, Vector(x + h_s * k3));
  return x + h_s / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

}  // namespace hedgehop::dynamics
