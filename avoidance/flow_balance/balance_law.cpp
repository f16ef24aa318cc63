#include "avoidance/flow_balance/balance_law.h"

#include <cmath>

namespace hedgehop::avoidance::flow_balance {

double saturated_divisor(double velocity_mps) {
  if (std::abs(velocity_mps) >= kDivisorFloorMps) return velocity_mps;
  return velocity_mps < 0.0 ? -kDivisorFloorMps : kDivisorFloorMps;
}

InverseRanges inverse_ranges(const SideFlow& side, const Eigen::Vector2d& v_H) {
  return {-side.flow_radps / saturated_divisor(v_H.dot(side.right_H)),
          side.loom_per_s / saturated_divisor(v_H.dot(side.axis_H))};
}

Eigen::Vector2d push_from_walls(std::span<const SideFlow> sides, const Eigen::Vector2d& v_H,
                                const BalanceGains& gains) {
  Eigen::Vector2d push_H = Eigen::Vector2d::Zero();
  for (const SideFlow& side : sides) {
    const InverseRanges inverse = inverse_ranges(side, v_H);
    push_H -= side.axis_H * (gains.loom_m2ps * inverse.from_loom_per_m + gains.flow_m2ps * inverse.from_flow_per_m);
  }
  return push_H;
}

Eigen::Vector2d normalized_command(const Eigen::Vector2d& v_tgt_H, const Eigen::Vector2d& push_H, double speed_mps) {
  constexpr double kNoDirectionMps = 1e-6;  // below this, the direction of the sum is rounding error
  const Eigen::Vector2d v_H = v_tgt_H + push_H;
  return (v_H.norm() < kNoDirectionMps ? v_tgt_H : v_H).normalized() * speed_mps;
}

}  // namespace hedgehop::avoidance::flow_balance
