#include "avoidance/flow_balance/detour.h"

namespace hedgehop::avoidance::flow_balance {

double Detour::update(double goal_distance_m, double t_s) {
  constexpr double kProgressM = 3.0;  // more than the position estimate wanders in a few seconds
  if (config_.patience_s <= 0.0) return 0.0;
  if (goal_distance_m < nearest_m_ - kProgressM) {
    nearest_m_ = goal_distance_m;
    progress_s_ = t_s;
  }
  if (t_s < until_s_) return side_ * config_.angle_rad;
  if (t_s - progress_s_ < config_.patience_s) return 0.0;
  side_ = -side_;
  until_s_ = t_s + config_.duration_s;
  progress_s_ = until_s_;
  ++count_;
  return side_ * config_.angle_rad;
}

}  // namespace hedgehop::avoidance::flow_balance
