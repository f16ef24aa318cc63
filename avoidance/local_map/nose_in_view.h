#pragma once

#include <algorithm>
#include <cmath>

#include "avoidance/local_map/moving_obstacles.h"
#include "avoidance/local_map/stop_planner.h"

namespace hedgehop::avoidance::local_map {

/// Returns the heading, limited so that an approaching obstacle stays in view. At high speed it is also limited
/// relative to the course, so that obstacles that enter the course from the other side are visible.
/// @param obstacle  nearest_approaching(); may be null. @param inspects  whether the nose points at unknown space,
/// which has precedence over the course.
inline double nose_in_view(const PathState& now, double nose_rad, const MovingObstacle* obstacle, double half_view_rad,
                           bool inspects) {
  constexpr double kShareOfView = 0.6, kAsideRad = 0.3, kFastMps = 3.0;
  const auto near_to = [&](const Eigen::Vector2d& along_W, double most_rad) {
    const double along_rad = std::atan2(along_W.y(), along_W.x());
    nose_rad = along_rad + std::clamp(std::remainder(nose_rad - along_rad, 2.0 * M_PI), -most_rad, most_rad);
  };
  if (obstacle) near_to(obstacle->p_W - now.p_W, kShareOfView * half_view_rad);
  if ((obstacle || !inspects) && now.v_W.norm() > kFastMps) near_to(now.v_W, kAsideRad);
  return nose_rad;
}

}  // namespace hedgehop::avoidance::local_map
