#include "dynamics/air/dryden.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hedgehop::dynamics::air {
namespace {

constexpr double kFootM = 0.3048;
using std::numbers::sqrt2;
using std::numbers::sqrt3;

/// 1 - e^-x (1 + x + ... + x^(n-1)/(n-1)!), without cancellation for small x: the variance that n integrations of
/// white noise gather in a step. @param n  1 to 3.
double gathered(int n, double x) {
  double term = 1.0;  // x^k / k!
  if (x > 0.5) {
    double sum = 0.0;
    for (int k = 0; k < n; term *= x / ++k) sum += term;
    return 1.0 - std::exp(-x) * sum;
  }
  for (int k = 1; k <= n; ++k) term *= x / k;
  double sum = 0.0;
  for (int k = n; term > 1e-20 * sum; term *= x / ++k) sum += term;
  return std::exp(-x) * sum;
}

}  // namespace

DrydenScales dryden_scales(double height_m, double w20_mps) {
  const double h_ft = std::clamp(height_m / kFootM, 10.0, 1000.0);
  const double d = 0.177 + 0.000823 * h_ft;
  DrydenScales s;
  s.length_w_m = h_ft * kFootM;
  s.length_uv_m = s.length_w_m / std::pow(d, 1.2);
  s.sigma_w_mps = 0.1 * w20_mps;
  s.sigma_uv_mps = s.sigma_w_mps / std::pow(d, 0.4);
  return s;
}

FirstOrderStep first_order_step(double path) { return {std::exp(-path), std::sqrt(gathered(1, 2.0 * path))}; }

SecondOrderStep second_order_step(double path) {
  SecondOrderStep step;
  step.decay << 1.0, 0.0, sqrt2 * path, 1.0;
  step.decay *= std::exp(-path);

  // Cholesky factor of the covariance gathered in the step.
  const double l11 = std::sqrt(gathered(1, 2.0 * path));
  const double l21 = l11 > 0.0 ? gathered(2, 2.0 * path) / (sqrt2 * l11) : 0.0;
  const double l22 = std::sqrt(std::max(0.0, gathered(3, 2.0 * path) - l21 * l21));
  step.noise << l11, 0.0, l21, l22;
  return step;
}

Eigen::RowVector2d second_order_output() { return {std::sqrt(1.5), 0.5 * (1.0 - sqrt3)}; }

}  // namespace hedgehop::dynamics::air
