#include "avoidance/flow_balance/turn_clearance.h"

#include <algorithm>

namespace hedgehop::avoidance::flow_balance {

double clearance_after_turn_m(const Turn& turn, const Eigen::Vector2d& towards_H, double range_m) {
  const double from_mps = turn.from_H.dot(towards_H), to_mps = turn.to_H.dot(towards_H);
  const double turning_s = (turn.to_H - turn.from_H).norm() / turn.stopping.braking_mps2;
  const double reacting_m = from_mps * turn.stopping.reaction_s;
  if (to_mps <= 0.0) {
    if (from_mps <= 0.0) return range_m;
    const double closing_s = turning_s * from_mps / (from_mps - to_mps);
    return range_m - reacting_m - 0.5 * from_mps * closing_s;
  }
  const double turning_m = 0.5 * (from_mps + to_mps) * turning_s;
  const double back_m = stopping_distance_m(to_mps, turn.to_H.norm(), turn.stopping);
  return range_m - std::max(0.0, reacting_m + turning_m) - back_m;
}

}  // namespace hedgehop::avoidance::flow_balance
