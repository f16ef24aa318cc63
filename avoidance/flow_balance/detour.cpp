#include "avoidance/flow_balance/detour.h"

namespace hedgehop::avoidance::flow_balance {

double Detour::update(double goal_distance_m, double t_s) {
  constexpr double kProgressM = 3.0;  // more than the position estimate drifts in a few seconds
  if (patience_s_ <= 0.0) return 0.0;
  if (goal_distance_m < nearest_m_ - kProgressM) {
    nearest_m_ = goal_distance_m;
    progress_s_ = t_s;
  }
  if (t_s < until_s_) return side_ * kAngleRad;
  if (t_s - progress_s_ < patience_s_) return 0.0;
  side_ = -side_;
  until_s_ = t_s + kDurationS;
  progress_s_ = until_s_;
  ++count_;
  return side_ * kAngleRad;
}

}  // namespace hedgehop::avoidance::flow_balance
