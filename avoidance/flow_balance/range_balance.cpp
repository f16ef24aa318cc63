#include "avoidance/flow_balance/range_balance.h"

#include <cmath>

namespace hedgehop::avoidance::flow_balance {

Eigen::Vector2d push_from_ranges(const SideAxes& axes_H, const PerSide& inverse_ranges_per_m, double gain_m2ps) {
  Eigen::Vector2d push_H = Eigen::Vector2d::Zero();
  for (size_t i = 0; i < axes_H.size(); ++i) push_H -= axes_H[i] * (gain_m2ps * inverse_ranges_per_m[i]);
  return push_H;
}

Eigen::Vector2d low_pass(const Eigen::Vector2d& v_last_W, const Eigen::Vector2d& v_W, double dt_s,
                         double time_constant_s) {
  if (time_constant_s <= 0.0) return v_W;
  return v_last_W + (1.0 - std::exp(-dt_s / time_constant_s)) * (v_W - v_last_W);
}

}  // namespace hedgehop::avoidance::flow_balance
