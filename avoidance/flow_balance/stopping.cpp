#include "avoidance/flow_balance/stopping.h"

#include <algorithm>
#include <cmath>

namespace hedgehop::avoidance::flow_balance {

double stopping_distance_m(double closing_mps, double reversing_mps, const Stopping& stopping) {
  return std::max(0.0, closing_mps) * (stopping.reaction_s + 0.5 * std::abs(reversing_mps) / stopping.braking_mps2);
}

double inverse_range_left_per_m(double inverse_range_per_m, double distance_m) {
  constexpr double kContactPerM = 1e3;  // 1 mm: finer than any range from flow
  const double share_left = 1.0 - inverse_range_per_m * distance_m;
  return inverse_range_per_m < kContactPerM * share_left ? inverse_range_per_m / share_left : kContactPerM;
}

}  // namespace hedgehop::avoidance::flow_balance
