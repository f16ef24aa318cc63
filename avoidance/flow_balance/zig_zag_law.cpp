#include "avoidance/flow_balance/zig_zag_law.h"

#include <cmath>

namespace hedgehop::avoidance::flow_balance {

int component_along(const Eigen::Vector2d& axis_H) { return std::abs(axis_H.x()) > std::abs(axis_H.y()) ? 0 : 1; }

bool is_too_near(const SideRange& side, double range_threshold_m) {
  return side.inverse_range_per_m * range_threshold_m > 1.0;
}

bool leads_towards(const Eigen::Vector2d& signs_H, const SideRange& side) {
  const int component = component_along(side.axis_H);
  return signs_H[component] * side.axis_H[component] > 0.0;
}

bool ZigZagLaw::update(std::span<const SideRange> sides) {
  const int before = reversals_;
  for (const SideRange& side : sides) {
    if (!is_too_near(side, diagonal_.range_threshold_m) || !leads_towards(signs_H_, side)) continue;
    signs_H_[component_along(side.axis_H)] *= -1.0;
    ++reversals_;
  }
  return reversals_ > before;
}

}  // namespace hedgehop::avoidance::flow_balance
