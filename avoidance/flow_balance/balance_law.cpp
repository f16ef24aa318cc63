#include "avoidance/flow_balance/balance_law.h"

#include <cmath>

namespace hedgehop::avoidance::flow_balance {

double saturated_divisor(double velocity_mps, double floor_mps) {
  if (std::abs(velocity_mps) >= floor_mps) return velocity_mps;
  return velocity_mps < 0.0 ? -floor_mps : floor_mps;
}

InverseRanges inverse_ranges(const WallSense& sense, const Eigen::Vector2d& v_H, double floor_mps) {
  return {-sense.flow_radps / saturated_divisor(v_H.dot(sense.right_H), floor_mps),
          sense.loom_per_s / saturated_divisor(v_H.dot(sense.axis_H), floor_mps)};
}

Eigen::Vector2d push_from_walls(std::span<const WallSense> senses, const Eigen::Vector2d& v_H, double loom_gain_m2ps,
                                double flow_gain_m2ps, double floor_mps) {
  Eigen::Vector2d push = Eigen::Vector2d::Zero();
  for (const WallSense& sense : senses) {
    const InverseRanges near = inverse_ranges(sense, v_H, floor_mps);
    push -= sense.axis_H * (loom_gain_m2ps * near.from_loom_per_m + flow_gain_m2ps * near.from_flow_per_m);
  }
  return push;
}

Eigen::Vector2d push_from_nearest(std::span<const WallSense> senses, double gain_m2ps) {
  Eigen::Vector2d push = Eigen::Vector2d::Zero();
  for (const WallSense& sense : senses) push -= sense.axis_H * (gain_m2ps * sense.near_per_m);
  return push;
}

}  // namespace hedgehop::avoidance::flow_balance
