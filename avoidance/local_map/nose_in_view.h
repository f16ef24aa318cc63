#pragma once

#include <algorithm>
#include <cmath>

#include "avoidance/heading.h"
#include "avoidance/local_map/moving_obstacles.h"
#include "avoidance/local_map/stop_planner.h"

namespace hedgehop::avoidance::local_map {

/// Returns the azimuth of a position from north to east, rad; `otherwise_rad` if it is nearer than 0.1 m.
inline double azimuth_rad(const Eigen::Vector2d& from_W, const Eigen::Vector2d& to_W, double otherwise_rad) {
  constexpr double kHereM = 0.1;
  const Eigen::Vector2d off_W = to_W - from_W;
  return off_W.norm() > kHereM ? std::atan2(off_W.y(), off_W.x()) : otherwise_rad;
}

/// Returns the heading, limited so that an approaching obstacle stays in view. At high speed it is also limited
/// relative to the course, so that obstacles that enter the course from the other side are visible.
/// @param obstacle  nearest_approaching(); may be null. @param inspects  whether the nose points at unknown space,
/// which has precedence over the course.
inline double nose_in_view(const PathState& now, double nose_rad, const MovingObstacle* obstacle, double half_view_rad,
                           bool inspects) {
  constexpr double kShareOfView = 0.6, kAsideRad = 0.3, kFastMps = 3.0;
  const auto near_to = [&](const Eigen::Vector2d& along_W, double most_rad) {
    const double along_rad = std::atan2(along_W.y(), along_W.x());
    nose_rad = along_rad + std::clamp(wrap_angle(nose_rad - along_rad), -most_rad, most_rad);
  };
  if (obstacle) near_to(obstacle->p_W - now.p_W, kShareOfView * half_view_rad);
  if ((obstacle || !inspects) && now.v_W.norm() > kFastMps) near_to(now.v_W, kAsideRad);
  return nose_rad;
}

}  // namespace hedgehop::avoidance::local_map
