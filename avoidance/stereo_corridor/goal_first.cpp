#include "avoidance/stereo_corridor/goal_first.h"

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
  constexpr double kSlowestMps = 0.5;  // so that it arrives
  return std::min(cruise_mps, std::max(kSlowestMps, std::sqrt(0.5 * acceleration_mps2 * distance_m)));
}

}  // namespace hedgehop::avoidance::stereo_corridor
