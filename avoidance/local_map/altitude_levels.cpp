#include "avoidance/local_map/altitude_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hedgehop::avoidance::local_map {
namespace {

constexpr double kNowhereM = std::numeric_limits<double>::infinity();
constexpr double kClimbPrice = 1.0;  // cost of a meter of climb or descent, in meters of path
constexpr double kOffGoalPrice =
    2.5;  // cost of a meter of altitude difference to the goal, higher because it must be flown later
// Minimum advantage of a level: less towards the altitude of the goal, and zero in the direction of the last change.
constexpr double kWorthM = 4.0, kWorthToGoalM = 2.0;
constexpr int kMaxLevels = 20;  // in each direction

}  // namespace

void AltitudeLevels::begin(double first_W) {
  first_W_ = first_W;
  if (!band_) return;
  highest_ = std::clamp(static_cast<int>(std::floor((band_->max_m + first_W) / kStepM)), 0, kMaxLevels);
  lowest_ = std::clamp(static_cast<int>(std::ceil((band_->min_m + first_W) / kStepM)), -kMaxLevels, 0);
}

/// Returns the distance to the goal along a level, m, including the cost of climbing to it and from it to the goal.
double AltitudeLevels::way_m(const Surroundings& around, const LearnedDistances& learned, int level,
                             const Eigen::Vector2d& p_W, const Eigen::Vector3d& goal_W) {
  const Eigen::Vector2d to_W = goal_W.head<2>();
  if (!around.slice_between(z_W(level), z_W(level), slice_)) return kNowhereM;
  route_.build(slice_, route_clearance_, to_W, learned.beyond_m(to_W, z_W(level)));
  return route_.to_goal_m(p_W).value_or(kNowhereM) + kClimbPrice * kStepM * std::abs(level - level_) +
         kOffGoalPrice * std::abs(z_W(level) - goal_W.z());
}

std::optional<double> AltitudeLevels::next_W(double t_s, const Surroundings& around, const LearnedDistances& learned,
                                             const Eigen::Vector2d& p_W, const Eigen::Vector3d& goal_W,
                                             const MayPass& may_pass) {
  constexpr double kEveryS = 1.0;
  if (lowest_ == highest_ || around.changes_height() || t_s < checked_s_ + kEveryS) return std::nullopt;
  checked_s_ = t_s;
  const double here_m = way_m(around, learned, level_, p_W, goal_W);
  double least_m = kNowhereM;
  int best = 0;  // number of levels to change by
  for (const int side : {1, -1}) {
    const int end = side > 0 ? highest_ : lowest_;
    double side_m = kNowhereM;
    for (int level = level_ + side; side * level <= side * end; level += side) {
      side_m = std::min(side_m, way_m(around, learned, level, p_W, goal_W));
    }
    const bool to_goal = std::abs(z_W(level_ + side) - goal_W.z()) < std::abs(z_W(level_) - goal_W.z());
    side_m += side == last_side_ ? 0.0 : to_goal ? kWorthToGoalM : kWorthM;
    if (!(side_m < std::min(here_m, least_m)) || !around.slice_between(z_W(level_), z_W(level_ + side), slice_) ||
        !may_pass(slice_)) {
      continue;
    }
    least_m = side_m;
    best = side;
  }
  if (best == 0) return std::nullopt;
  level_ += best;
  last_side_ = best;
  return z_W(level_);
}

}  // namespace hedgehop::avoidance::local_map
