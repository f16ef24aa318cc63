#include "avoidance/flow_balance/confirmed_zig_zag.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace hedgehop::avoidance::flow_balance {
namespace {

/// Images that must agree. A wrong flow vector seldom occurs in two successive images.
constexpr int kConfirmations = 2;

}  // namespace

Eigen::Vector2d ConfirmedZigZag::velocity_H() const {
  return Eigen::Rotation2Dd(stray_rad_) * signs_H_.cwiseProduct(diagonal_.speed_mps);
}

bool ConfirmedZigZag::in_corner(std::span<const SideRange> sides) const {
  std::array<bool, 2> near{};
  for (const SideRange& side : sides) {
    if (is_too_near(side, diagonal_.range_threshold_m) && leads_towards(signs_H_, side)) {
      near[static_cast<size_t>(component_along(side.axis_H))] = true;
    }
  }
  return near[0] && near[1];
}

bool ConfirmedZigZag::update(std::span<const SideRange> sides) {
  confirmed_.resize(sides.size(), 0);
  const SideRange* nearest = nullptr;
  for (size_t i = 0; i < sides.size(); ++i) {
    const SideRange& side = sides[i];
    if (!side.fresh) continue;
    confirmed_[i] = is_too_near(side, diagonal_.range_threshold_m) ? confirmed_[i] + 1 : 0;
    if (confirmed_[i] < kConfirmations || !leads_towards(signs_H_, side)) continue;
    if (!nearest || side.inverse_range_per_m > nearest->inverse_range_per_m) nearest = &side;
  }
  if (!nearest) return false;
  signs_H_[component_along(nearest->axis_H)] *= -1.0;
  std::fill(confirmed_.begin(), confirmed_.end(), 0);
  stray_rad_ = max_stray_rad_ * uniform(random_, -1.0, 1.0);
  ++reversals_;
  return true;
}

}  // namespace hedgehop::avoidance::flow_balance
