#include "dynamics/air/wind.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/fields/bounds.h"

namespace hedgehop::dynamics::air {

double gust_speed_mps(const GustConfig& c, double path_m) {
  const double whole_m = 2.0 * c.length_m + c.hold_m;
  const double from_edge_m = std::clamp(std::min(path_m, whole_m - path_m), 0.0, c.length_m);
  return 0.5 * c.speed_mps * (1.0 - std::cos(std::numbers::pi * from_edge_m / c.length_m));
}

namespace {

constexpr double kFootM = 0.3048;
using std::numbers::sqrt2;
using std::numbers::sqrt3;

/// Returns 1 - e^-x (1 + x + ... + x^(n-1)/(n-1)!), without cancellation for small x: the variance that n integrations
/// of white noise accumulate in a step. @param n  1 to 3.
double accumulated_variance(int n, double x) {
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

FirstOrderStep first_order_step(double path) {
  return {std::exp(-path), std::sqrt(accumulated_variance(1, 2.0 * path))};
}

SecondOrderStep second_order_step(double path) {
  SecondOrderStep step;
  step.decay << 1.0, 0.0, sqrt2 * path, 1.0;
  step.decay *= std::exp(-path);

  // Cholesky factor of the covariance that accumulates in the step.
  const double l11 = std::sqrt(accumulated_variance(1, 2.0 * path));
  const double l21 = l11 > 0.0 ? accumulated_variance(2, 2.0 * path) / (sqrt2 * l11) : 0.0;
  const double l22 = std::sqrt(std::max(0.0, accumulated_variance(3, 2.0 * path) - l21 * l21));
  step.noise << l11, 0.0, l21, l22;
  return step;
}

Eigen::RowVector2d second_order_output() { return {std::sqrt(1.5), 0.5 * (1.0 - sqrt3)}; }

namespace {

constexpr double kMinAirspeedMps = 1.0;                    // chosen: the field moves past even in a hover in still air
constexpr double kW20HeightM = 6.096, kShearTopM = 304.8;  // 20 ft and 1000 ft

/// Returns the direction of a wind that comes from a heading.
Eigen::Vector3d wind_direction_W(double from_rad) { return {-std::cos(from_rad), -std::sin(from_rad), 0.0}; }

}  // namespace

Wind::Wind(const WindConfig& config, uint64_t seed) : config_(fields::require_bounds(config)), noise_(seed) {
  gust_along_W_ = wind_direction_W(config.gust.from_rad);
  double from_rad = config.from_rad;
  if (config.spread_rad > 0.0) {
    const double share = 2.0 * noise_.uniform() - 1.0;
    from_rad += share * config.spread_rad;
  }
  const Eigen::Vector3d direction_W = wind_direction_W(from_rad);
  steady_W_ = config.speed_mps * direction_W;
  // Without a steady wind the axes are those of W.
  const Eigen::Vector3d along_W = config.speed_mps > 0.0 ? direction_W : Eigen::Vector3d::UnitX();
  R_WT_ << along_W, Eigen::Vector3d::UnitZ().cross(along_W), Eigen::Vector3d::UnitZ();
  draw_stationary();
}

/// The correlation of the two scaled states is 1/sqrt(2).
void Wind::draw_stationary() {
  u_ = noise_.normal();
  for (Eigen::Vector2d* z : {&v_, &w_}) {
    (*z)[0] = noise_.normal();
    (*z)[1] = ((*z)[0] + noise_.normal()) / std::numbers::sqrt2;
  }
}

Eigen::Vector3d Wind::steady_W(double height_m) const {
  const double z0 = config_.roughness_m;
  if (z0 == 0.0) return steady_W_;
  const double h = std::clamp(height_m, z0, kShearTopM);
  return std::log(h / z0) / std::log(kW20HeightM / z0) * steady_W_;
}

Eigen::Vector3d Wind::sample(double height_m, const Eigen::Vector3d& v_WB_W, double dt_s) {
  const Eigen::Vector3d steady_W = this->steady_W(height_m);
  const double airspeed_mps = std::max((v_WB_W - steady_W).norm(), kMinAirspeedMps);
  Eigen::Vector3d air_W = steady_W;
  if (config_.turbulence_w20_mps > 0.0) air_W += turbulence_W(height_m, airspeed_mps * dt_s);
  if (config_.gust.speed_mps > 0.0 && gust_runs_) {
    t_s_ += dt_s;
    gust_path_m_ += airspeed_mps * std::clamp(t_s_ - config_.gust.start_s, 0.0, dt_s);
    air_W += gust_speed_mps(config_.gust, gust_path_m_) * gust_along_W_;
  }
  return air_W;
}

/// Advances the filters by a distance through the air.
Eigen::Vector3d Wind::turbulence_W(double height_m, double path_m) {
  const DrydenScales s = dryden_scales(height_m, config_.turbulence_w20_mps);
  const FirstOrderStep u = first_order_step(path_m / s.length_uv_m);
  u_ = u.decay * u_ + u.noise * noise_.normal();
  advance(v_, second_order_step(path_m / s.length_uv_m));
  advance(w_, second_order_step(path_m / s.length_w_m));

  const Eigen::RowVector2d output = second_order_output();
  const Eigen::Vector3d gust_T{s.sigma_uv_mps * u_, s.sigma_uv_mps * output.dot(v_), s.sigma_w_mps * output.dot(w_)};
  return R_WT_ * gust_T;
}

void Wind::advance(Eigen::Vector2d& z, const SecondOrderStep& step) {
  // Two statements, because the order of evaluation of arguments is unspecified.
  const double eta1 = noise_.normal();
  const double eta2 = noise_.normal();
  z = step.decay * z + step.noise * Eigen::Vector2d{eta1, eta2};
}

}  // namespace hedgehop::dynamics::air
