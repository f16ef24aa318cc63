#include "dynamics/air/wind.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/fields/bounds.h"

namespace hedgehop::dynamics::air {
namespace {

constexpr double kLowestAirspeedMps = 1.0;  ///< chosen: in a hover in still air the field still drifts past
constexpr double kW20HeightM = 6.096, kShearTopM = 304.8;  ///< 20 ft and 1000 ft

/// The way a wind blows that comes from a heading.
Eigen::Vector3d blowing_W(double from_rad) { return {-std::cos(from_rad), -std::sin(from_rad), 0.0}; }

}  // namespace

Wind::Wind(const WindConfig& config, uint64_t seed) : config_(fields::require_bounds(config)), noise_(seed) {
  gust_along_W_ = blowing_W(config.gust.from_rad);
  double from_rad = config.from_rad;
  if (config.spread_rad > 0.0) {
    // Evenly from [-1, 1), of 53 random bits: the same on every standard library.
    const double share = 2.0 * noise_.uniform() - 1.0;
    from_rad += share * config.spread_rad;
  }
  const Eigen::Vector3d blows_W = blowing_W(from_rad);
  steady_W_ = config.speed_mps * blows_W;
  // Without a mean wind the axes are W's.
  const Eigen::Vector3d along_W = config.speed_mps > 0.0 ? blows_W : Eigen::Vector3d::UnitX();
  R_WT_ << along_W, Eigen::Vector3d::UnitZ().cross(along_W), Eigen::Vector3d::UnitZ();
  draw_stationary();
}

/// Correlation of the two scaled states is 1/sqrt(2).
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
  const double airspeed_mps = std::max((v_WB_W - steady_W).norm(), kLowestAirspeedMps);
  Eigen::Vector3d air_W = steady_W;
  if (config_.turbulence_w20_mps > 0.0) air_W += turbulence_W(height_m, airspeed_mps * dt_s);
  if (config_.gust.speed_mps > 0.0) {
    t_s_ += dt_s;
    gust_path_m_ += airspeed_mps * std::clamp(t_s_ - config_.gust.start_s, 0.0, dt_s);
    air_W += gust_speed_mps(config_.gust, gust_path_m_) * gust_along_W_;
  }
  return air_W;
}

/// Moves the filters on by a way through the air.
Eigen::Vector3d Wind::turbulence_W(double height_m, double path_m) {
  const DrydenScales s = dryden_scales(height_m, config_.turbulence_w20_mps);
  const FirstOrderStep u = first_order_step(path_m / s.length_uv_m);
  u_ = u.decay * u_ + u.noise * noise_.normal();
  move(v_, second_order_step(path_m / s.length_uv_m));
  move(w_, second_order_step(path_m / s.length_w_m));

  const Eigen::RowVector2d output = second_order_output();
  const Eigen::Vector3d gust_T{s.sigma_uv_mps * u_, s.sigma_uv_mps * output.dot(v_), s.sigma_w_mps * output.dot(w_)};
  return R_WT_ * gust_T;
}

void Wind::move(Eigen::Vector2d& z, const SecondOrderStep& step) {
  // Draws stand in statements of their own: the order of evaluation of arguments is unspecified.
  const double eta1 = noise_.normal();
  const double eta2 = noise_.normal();
  z = step.decay * z + step.noise * Eigen::Vector2d{eta1, eta2};
}

}  // namespace hedgehop::dynamics::air
