#include "scenes/motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

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

/// Time in the table, and the direction in which the table is read: 1 or -1, 0 at rest.
struct TableTime {
  double t_s;
  double direction;
};

TableTime table_time(const TableMotion& motion, double t_s) {
  using enum TableMotion::Repeat;
  const double run_s = t_s - motion.start_s, whole_s = motion.poses->duration_s();
  if (run_s < 0.0 || whole_s == 0.0) return {0.0, 0.0};
  if (run_s < whole_s) return {run_s, 1.0};
  if (motion.repeat == once) return {whole_s, 0.0};
  if (motion.repeat == restart) return {std::fmod(run_s, whole_s), 1.0};
  const double lap_s = std::fmod(run_s, 2.0 * whole_s);
  return lap_s < whole_s ? TableTime{lap_s, 1.0} : TableTime{2.0 * whole_s - lap_s, -1.0};
}

/// Returns the rates at a time, whose direction is that of the next moment.
PoseTable::Rates rates_at(const TableMotion& motion, double t_s) {
  constexpr double kJustBeforeS = 1e-9;  // on the way back, the interval before a row is the next one
  const auto [table_s, direction] = table_time(motion, t_s);
  if (direction == 0.0) return {};
  PoseTable::Rates rates = motion.poses->rates(direction < 0.0 ? table_s - kJustBeforeS : table_s);
  rates.v_mps *= direction;
  return rates;
}

PathPoint point_at(const TableMotion& motion, double t_s) {
  return {motion.poses->at(table_time(motion, t_s).t_s).p_WM, rates_at(motion, t_s).v_mps};
}

}  // namespace

void load_motion(Motion& motion) {
  auto* const table = std::get_if<TableMotion>(&motion);
  if (!table || table->poses) return;
  try {
    table->poses = std::make_shared<const PoseTable>(read_pose_table(table->file));
  } catch (const std::invalid_argument& fault) {
    throw fields::InvalidField("motion.file", "'" + table->file + "': " + fault.what());
  }
}

void require_motion(const Motion& motion) {
  std::visit([](const auto& chosen) { fields::require_bounds(chosen, "motion"); }, motion);
  if (const auto* straight = std::get_if<WaypointMotion>(&motion)) {
    require(!straight->points.empty(), "motion.points", 0.0, "at least one point");
  }
  if (const auto* table = std::get_if<TableMotion>(&motion); table && !table->poses) {
    throw fields::InvalidField("motion.file", "'" + table->file + "' is not loaded");
  }
}

Eigen::Vector3d p_WM(const Motion& motion, double t_s) {
  return std::visit([t_s](const auto& chosen) { return point_at(chosen, t_s).p_W; }, motion);
}

Eigen::Isometry3d X_WM(const Motion& motion, double t_s) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  if (const auto* table = std::get_if<TableMotion>(&motion)) {
    const PoseRow row = table->poses->at(table_time(*table, t_s).t_s);
    X.linear() = row.q_WM.toRotationMatrix();
    X.translation() = row.p_WM;
  } else {
    X.translation() = p_WM(motion, t_s);
  }
  return X;
}

Eigen::Vector3d v_WM(const Motion& motion, double t_s) {
  return std::visit([t_s](const auto& chosen) { return point_at(chosen, t_s).v_W; }, motion);
}

double max_speed_mps(const Motion& motion, double reach_m, double t_s) {
  const double speed_mps = v_WM(motion, t_s).norm();
  const auto* const table = std::get_if<TableMotion>(&motion);
  return table ? speed_mps + rates_at(*table, t_s).turn_radps * reach_m : speed_mps;
}

std::vector<Eigen::Vector3d> path_W(const Motion& motion) {
  if (const auto* straight = std::get_if<WaypointMotion>(&motion)) return corners_W(*straight);
  if (const auto* table = std::get_if<TableMotion>(&motion)) {
    std::vector<Vector3d> rows_W;
    for (const PoseRow& row : table->poses->rows()) rows_W.push_back(row.p_WM);
    return rows_W;
  }
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
