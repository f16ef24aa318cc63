#include "scenes/motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/world_config.h"
#include "sim/fields/bounds.h"

namespace hedgehop::scenes {
namespace {

using Eigen::Vector3d;
using Repeat = WaypointMotion::Repeat;

struct PathPoint {
  Vector3d p_W = Vector3d::Zero();
  Vector3d v_W = Vector3d::Zero();
};

std::vector<Vector3d> corners_W(const WaypointMotion& motion) {
  std::vector<Vector3d> corners;
  for (const Waypoint& point : motion.points) corners.push_back(point.p_W());
  if (motion.repeat == Repeat::round) corners.push_back(corners.front());
  return corners;
}

double length_m(const std::vector<Vector3d>& corners) {
  double length = 0.0;
  for (size_t i = 1; i < corners.size(); ++i) length += (corners[i] - corners[i - 1]).norm();
  return length;
}

// Returns the point at distance `path_m` along the corners and the direction of travel as a unit vector. At a corner
// the direction is that of the next leg, or of the previous leg on the way back.
PathPoint point_along(const std::vector<Vector3d>& corners, double path_m, bool back) {
  PathPoint point{corners.front(), Vector3d::Zero()};
  for (size_t i = 1; i < corners.size(); ++i) {
    const Vector3d leg = corners[i] - corners[i - 1];
    const double leg_m = leg.norm();
    if (leg_m == 0.0) continue;
    point = {corners[i - 1] + std::min(path_m / leg_m, 1.0) * leg, leg / leg_m};
    if (back ? path_m <= leg_m : path_m < leg_m) break;
    path_m -= leg_m;
  }
  return point;
}

PathPoint point_at(const WaypointMotion& motion, double t_s) {
  const std::vector<Vector3d> corners = corners_W(motion);
  const double total_m = length_m(corners), run_m = motion.speed_mps * (t_s - motion.start_s);
  if (total_m == 0.0 || motion.speed_mps == 0.0 || run_m < 0.0) return {corners.front(), Vector3d::Zero()};
  if (motion.repeat == Repeat::once && run_m >= total_m) return {corners.back(), Vector3d::Zero()};

  const double lap_m = motion.repeat == Repeat::back_and_forth ? 2.0 * total_m : total_m;
  const double path_m = motion.repeat == Repeat::once ? run_m : std::fmod(run_m, lap_m);
  const bool back = path_m >= total_m;
  PathPoint here = point_along(corners, back ? lap_m - path_m : path_m, back);
  here.v_W *= back ? -motion.speed_mps : motion.speed_mps;
  return here;
}

PathPoint point_at(const OrbitMotion& motion, double t_s) {
  const bool started = t_s >= motion.start_s;
  const double turned_rad = started ? motion.speed_mps * (t_s - motion.start_s) / motion.radius_m : 0.0;
  const double bearing_rad = motion.bearing_rad + turned_rad;
  const Vector3d out(std::cos(bearing_rad), std::sin(bearing_rad), 0.0);
  const Vector3d onward(-out.y(), out.x(), 0.0);
  return {Vector3d(motion.north_m, motion.east_m, -motion.altitude_m) + motion.radius_m * out,
          started ? Vector3d(motion.speed_mps * onward) : Vector3d::Zero()};
}

}  // namespace

void require_motion(const Motion& motion) {
  std::visit([](const auto& chosen) { fields::require_bounds(chosen, "motion"); }, motion);
  if (const auto* straight = std::get_if<WaypointMotion>(&motion)) {
    require(!straight->points.empty(), "motion.points", 0.0, "at least one point");
  }
}

Eigen::Vector3d p_WM(const Motion& motion, double t_s) {
  return std::visit([t_s](const auto& chosen) { return point_at(chosen, t_s).p_W; }, motion);
}

Eigen::Vector3d v_WM(const Motion& motion, double t_s) {
  return std::visit([t_s](const auto& chosen) { return point_at(chosen, t_s).v_W; }, motion);
}

std::vector<Eigen::Vector3d> path_W(const Motion& motion) {
  if (const auto* straight = std::get_if<WaypointMotion>(&motion)) return corners_W(*straight);
  constexpr int kCorners = 64;
  OrbitMotion orbit = std::get<OrbitMotion>(motion);
  const double first_rad = orbit.bearing_rad;
  std::vector<Vector3d> corners;
  for (int k = 0; k < kCorners; ++k) {
    orbit.bearing_rad = first_rad + 2.0 * std::numbers::pi * k / kCorners;
    corners.push_back(point_at(orbit, 0.0).p_W);
  }
  corners.push_back(corners.front());
  return corners;
}

}  // namespace hedgehop::scenes
