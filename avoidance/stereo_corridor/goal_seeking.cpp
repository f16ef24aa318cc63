#include "avoidance/stereo_corridor/goal_seeking.h"

#include <algorithm>
#include <cmath>

namespace hedgehop::avoidance::stereo_corridor {

std::optional<Target> choose_goal_first(CorridorSearch& search, const Eigen::Vector3d& p_CG_C,
                                        const Eigen::Vector3d& v_WB_C, const std::optional<cv::Point>& followed) {
  if (!search.pixel_of(p_CG_C)) {
    if (const auto found = search.below_or_above(p_CG_C)) return found;
    return search.anywhere(p_CG_C);
  }
  if (const auto ahead = search.along(p_CG_C, FoundBy::goal)) return ahead;
  if (is_moving(v_WB_C)) return search.join(v_WB_C, followed);
  if (const auto found = search.near(followed)) return found;
  return search.anywhere(p_CG_C);
}

double approach_speed_mps(double cruise_mps, double distance_m, double acceleration_mps2) {
  constexpr double kMinSpeedMps = 0.5;  // ensures arrival
  return std::min(cruise_mps, std::max(kMinSpeedMps, std::sqrt(0.5 * acceleration_mps2 * distance_m)));
}

bool TurnBack::update(const Eigen::Vector3d& p_CG_C, const Eigen::Vector3d& p_WB) {
  constexpr double kAhead = 0.2;       // tangent of the bearing: the goal is near the image center
  constexpr double kNearerM = 3.0;     // progress that makes the last turn a success
  constexpr double kWanderM = 0.3;     // drift of the position estimate while a goal is passed
  constexpr double kElsewhereM = 3.0;  // distance after which another street may be visible
  const double distance_m = std::hypot(p_CG_C.x(), p_CG_C.z());
  nearest_m_ = std::min(nearest_m_, distance_m);
  if (distance_m < nearest_ever_m_ - kNearerM) {
    nearest_ever_m_ = distance_m;
    may_pass_m_ = kMayPassM;
  }
  if (!turning_ && side_ && (p_WB - p_turned_W_).norm() > kElsewhereM) side_.reset();
  const bool recedes = distance_m > nearest_m_ + kWanderM;
  if (!turning_ && recedes && -p_CG_C.z() > may_pass_m_) {
    turning_ = true;
  } else if (turning_ && std::abs(p_CG_C.x()) < kAhead * p_CG_C.z()) {
    turning_ = false;
    const double passed_m = std::sqrt(distance_m * distance_m - nearest_m_ * nearest_m_);
    may_pass_m_ = std::max(2.0 * may_pass_m_, passed_m + kElsewhereM);
    nearest_m_ = distance_m;
    p_turned_W_ = p_WB;
    if (tries_ahead_) side_ = -*side_;
    tries_ahead_ = !tries_ahead_;
  }
  if (turning_) side_ = std::copysign(1.0, p_CG_C.x());
  return turning_;
}

}  // namespace hedgehop::avoidance::stereo_corridor
