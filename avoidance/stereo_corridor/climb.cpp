#include "avoidance/stereo_corridor/climb.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hedgehop::avoidance::stereo_corridor {

double slope_of(const Eigen::Vector3d& direction_W) { return -direction_W.z() / direction_W.head<2>().norm(); }

double climbing_speed_mps(double slope, const ClimbLimits& limits) {
  return slope != 0.0 ? limits.rate_mps / std::abs(slope) : std::numeric_limits<double>::infinity();
}

double lag_behind_ray_m(double slope, double speed_mps, const ClimbLimits& limits) {
  constexpr double kReactionS = 0.5;  // from the image to the first vertical motion
  const double excess_mps = std::max(0.0, speed_mps - climbing_speed_mps(slope, limits));
  return std::abs(slope) * (speed_mps * kReactionS + excess_mps * excess_mps / (2.0 * limits.acceleration_mps2));
}

double altitude_along_ray_m(double altitude_m, double slope, double speed_mps) {
  constexpr double kLeadS = 1.0;  // about the time in which an autopilot corrects its altitude
  return altitude_m + kLeadS * speed_mps * slope;
}

}  // namespace hedgehop::avoidance::stereo_corridor
