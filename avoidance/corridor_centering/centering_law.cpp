#include "avoidance/corridor_centering/centering_law.h"

#include <algorithm>
#include <cmath>

namespace hedgehop::avoidance::corridor_centering {

double printed_control(const CenteringGains& gains, double error, double last_error) {
  return (gains.kp + gains.kd) * error - gains.kp * last_error;
}

double pursuit_course_rad(const vision::corridor::Gap& gap, double ahead_m, double most_rad) {
  const double course_rad = std::atan2(vision::corridor::middle_offset_m(gap.left_m, gap.right_m), ahead_m);
  return std::clamp(course_rad, -most_rad, most_rad);
}

double clearance_speed_mps(double aside_m, double ahead_m, const SpeedLimits& limits) {
  const double a = limits.stop_mps2, t = limits.reaction_s;
  // v t + v^2 / (2 a) = way ahead
  const double way_m = std::max(0.0, ahead_m);
  const double stopping_mps = std::isinf(way_m) ? limits.speed_mps : a * (std::sqrt(t * t + 2.0 * way_m / a) - t);
  return std::min({limits.speed_mps, std::max(0.0, aside_m) / limits.aside_s, stopping_mps});
}

}  // namespace hedgehop::avoidance::corridor_centering
