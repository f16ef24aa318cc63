#include "dynamics/wind.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace hedgehop::dynamics {
namespace {

constexpr double kLowestAirspeedMps = 1.0;  ///< chosen: in a hover in still air the field still drifts past

}  // namespace

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
    (*z)[1] = ((*z)[0] + normal()) / std::numbers::sqrt2;
  }
}

Eigen::Vector3d Wind::sample(double height_m, const Eigen::Vector3d& v_WB_W, double dt_s) {
  if (config_.turbulence_w20_mps == 0.0) return steady_W_;
  const DrydenScales s = dryden_scales(height_m, config_.turbulence_w20_mps);
  const double path_m = std::max((v_WB_W - steady_W_).norm(), kLowestAirspeedMps) * dt_s;

  const FirstOrderStep u = first_order_step(path_m / s.length_uv_m);
  u_ = u.decay * u_ + u.noise * normal();
  move(v_, second_order_step(path_m / s.length_uv_m));
  move(w_, second_order_step(path_m / s.length_w_m));

  const Eigen::RowVector2d output = second_order_output();
  const Eigen::Vector3d gust_T{s.sigma_uv_mps * u_, s.sigma_uv_mps * output.dot(v_), s.sigma_w_mps * output.dot(w_)};
  return steady_W_ + R_WT_ * gust_T;
}

void Wind::move(Eigen::Vector2d& z, const SecondOrderStep& step) {
  // Draws stand in statements of their own: the order of evaluation of arguments is unspecified.
  const double eta1 = normal();
  const double eta2 = normal();
  z = step.decay * z + step.noise * Eigen::Vector2d{eta1, eta2};
}

}  // namespace hedgehop::dynamics
