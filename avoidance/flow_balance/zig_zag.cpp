#include "avoidance/flow_balance/zig_zag.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace hedgehop::avoidance::flow_balance {
namespace {

int component_along(const Eigen::Vector2d& axis_H) { return std::abs(axis_H.x()) > std::abs(axis_H.y()) ? 0 : 1; }

/// Uniform in [-1, 1), the same with every standard library.
double symmetric_draw(std::mt19937_64& random) { return std::ldexp(static_cast<double>(random() >> 11), -52) - 1.0; }

}  // namespace

double stopping_distance_m(double closing_mps, double turning_mps, const Stopping& stopping) {
  return std::max(0.0, closing_mps) * (stopping.reaction_s + 0.5 * std::abs(turning_mps) / stopping.braking_mps2);
}

double near_once_stopped_per_m(double near_per_m, double stopping_distance_m) {
  constexpr double kTouchingPerM = 1e3;
  const double share_left = 1.0 - near_per_m * stopping_distance_m;
  return near_per_m < kTouchingPerM * share_left ? near_per_m / share_left : kTouchingPerM;
}

Eigen::Vector2d ZigZag::way_H() const {
  return Eigen::Rotation2Dd(stray_rad_) * signs_H_.cwiseProduct(config_.speed_mps);
}

bool ZigZag::leads_towards(const Side& side) const {
  const int component = component_along(side.axis_H);
  return signs_H_[component] * side.axis_H[component] > 0.0;
}

bool ZigZag::cornered(std::span<const Side> sides) const {
  std::array<bool, 2> near{};
  for (const Side& side : sides) {
    if (too_near(side) && leads_towards(side)) near[static_cast<size_t>(component_along(side.axis_H))] = true;
  }
  return near[0] && near[1];
}

bool ZigZag::update(std::span<const Side> sides) {
  confirmed_.resize(sides.size(), 0);
  const Side* nearest = nullptr;
  for (size_t i = 0; i < sides.size(); ++i) {
    const Side& side = sides[i];
    if (!side.fresh) continue;
    confirmed_[i] = too_near(side) ? confirmed_[i] + 1 : 0;
    if (confirmed_[i] < config_.confirmations || !leads_towards(side)) continue;
    if (!nearest || side.near_per_m > nearest->near_per_m) nearest = &side;
  }
  if (!nearest) return false;
  double& turning = signs_H_[component_along(nearest->axis_H)];
  turning = -turning;
  std::fill(confirmed_.begin(), confirmed_.end(), 0);
  stray_rad_ = config_.stray_rad * symmetric_draw(random_);
  ++reversals_;
  return true;
}

}  // namespace hedgehop::avoidance::flow_balance
