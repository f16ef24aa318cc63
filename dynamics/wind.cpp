#include "dynamics/wind.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace hedgehop::dynamics {
namespace {

constexpr double kFootM = 0.3048;
constexpr double kLowestAirspeedMps = 1.0;  ///< chosen: in a hover in still air the field still drifts past
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

/// One exact step of the chain z1' = -z1 + noise, z2' = sqrt(2) z1 - z2 (time in units of L/V), both of unit stationary
/// variance. @param step  A T = V dt / L.
Eigen::Vector2d advance(const Eigen::Vector2d& z, double step, double eta1, double eta2) {
  const double decay = std::exp(-step);
  const double q11 = gathered(1, 2.0 * step);
  const double q12 = gathered(2, 2.0 * step) / sqrt2;
  const double q22 = gathered(3, 2.0 * step);
  const double l11 = std::sqrt(q11);
  const double l21 = l11 > 0.0 ? q12 / l11 : 0.0;
  const double l22 = std::sqrt(std::max(0.0, q22 - l21 * l21));
  return {decay * z[0] + l11 * eta1, decay * (sqrt2 * step * z[0] + z[1]) + l21 * eta1 + l22 * eta2};
}

/// The output of H = sqrt(L/V) (1 + sqrt(3) s L/V) / (1 + s L/V)^2, of unit variance.
double output(const Eigen::Vector2d& z) { return std::sqrt(1.5) * z[0] + 0.5 * (1.0 - sqrt3) * z[1]; }

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

Wind::Wind(const WindConfig& config, uint64_t seed) : config_(config), generator_(seed) {
  for (const double value : {config.speed_mps, config.from_rad, config.turbulence_w20_mps}) {
    if (!std::isfinite(value)) throw std::invalid_argument("the wind must be finite");
  }
  if (config.speed_mps < 0.0 || config.turbulence_w20_mps < 0.0) {
    throw std::invalid_argument("wind speeds must not be negative");
  }
  const Eigen::Vector3d blows_W{-std::cos(config.from_rad), -std::sin(config.from_rad), 0.0};
  steady_W_ = config.speed_mps * blows_W;
  // Without a mean wind the axes are W's.
  const Eigen::Vector3d along_W = config.speed_mps > 0.0 ? blows_W : Eigen::Vector3d::UnitX();
  R_WT_ << along_W, Eigen::Vector3d::UnitZ().cross(along_W), Eigen::Vector3d::UnitZ();
  draw_stationary();
}

/// Correlation of the two scaled states is 1/sqrt(2).
void Wind::draw_stationary() {
  u_ = normal();
  for (Eigen::Vector2d* z : {&v_, &w_}) {
    (*z)[0] = normal();
    (*z)[1] = ((*z)[0] + normal()) / sqrt2;
  }
}

Eigen::Vector3d Wind::sample(double height_m, const Eigen::Vector3d& v_WB_W, double dt_s) {
  if (config_.turbulence_w20_mps == 0.0) return steady_W_;
  const DrydenScales s = dryden_scales(height_m, config_.turbulence_w20_mps);
  const double path_m = std::max((v_WB_W - steady_W_).norm(), kLowestAirspeedMps) * dt_s;

  const double step_uv = path_m / s.length_uv_m;
  const double step_w = path_m / s.length_w_m;
  u_ = std::exp(-step_uv) * u_ + std::sqrt(gathered(1, 2.0 * step_uv)) * normal();
  // Draws stand in statements of their own: the order of evaluation of arguments is unspecified.
  for (auto& [z, step] : {std::pair{&v_, step_uv}, std::pair{&w_, step_w}}) {
    const double eta1 = normal();
    const double eta2 = normal();
    *z = advance(*z, step, eta1, eta2);
  }
  return steady_W_ +
         R_WT_ * Eigen::Vector3d{s.sigma_uv_mps * u_, s.sigma_uv_mps * output(v_), s.sigma_w_mps * output(w_)};
}

}  // namespace hedgehop::dynamics
