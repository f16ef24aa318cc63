#include "sim/verdict/field_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/collision/proximity.h"
#include "sim/verdict/shortest_path.h"

namespace hedgehop::sim {
namespace {

using Rows = std::vector<TrajectoryRow>;

/// Path length of a free flight from the first position to the goal's circle, m: a disc of the vehicle's radius at the
/// goal's altitude.
std::optional<double> shortest_free_path_m(const GoalConfig& goal, const Eigen::Vector3d& start_W,
                                           const scenes::Scene& scene, double vehicle_radius_m) {
  constexpr double kHalfThicknessM = 0.05, kFinestCellM = 0.25, kMostCells = 400.0, kMarginM = 5.0, kAtStartS = 0.0;
  const dynamics::HullPart disc{.shape = dynamics::HullPart::Shape::cylinder,
                                .half_extents_m = {vehicle_radius_m, vehicle_radius_m, kHalfThicknessM}};
  CollisionWorld world(scene, {disc});
  Eigen::AlignedBox2d bounds = scene.bounds_NE_m;
  bounds.extend(Eigen::Vector2d(start_W.head<2>())).extend(Eigen::Vector2d(goal.p_WG().head<2>()));
  bounds = {bounds.min().array() - kMarginM, bounds.max().array() + kMarginM};
  const double cell_m = std::max(kFinestCellM, bounds.sizes().maxCoeff() / kMostCells);
  const auto is_free = [&](const Eigen::Vector2d& p_NE_m) {
    Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
    X_WB.translation() = Eigen::Vector3d(p_NE_m.x(), p_NE_m.y(), goal.p_WG().z());
    return !world.query(X_WB, kHalfThicknessM, kAtStartS).collided;
  };
  const auto length_m = shortest_path_m(start_W.head<2>(), goal.p_WG().head<2>(), bounds, cell_m, is_free);
  if (!length_m) return {};
  return std::max(0.0, *length_m - goal.radius_m);
}

/// Distance in the plan from the course that leads straight from the start over the route's places to the goal, m.
double off_course_m(const Scenario& scenario, const Eigen::Vector2d& start_NE, const Eigen::Vector2d& p_NE) {
  std::vector<Eigen::Vector2d> turns{start_NE};
  for (const GoalConfig& place : scenario.route) turns.emplace_back(place.p_WG().head<2>());
  turns.emplace_back(scenario.goal->p_WG().head<2>());
  double least_m = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i + 1 < turns.size(); ++i) {
    const Eigen::Vector2d leg = turns[i + 1] - turns[i];
    const double share = std::clamp((p_NE - turns[i]).dot(leg) / std::max(leg.squaredNorm(), 1e-12), 0.0, 1.0);
    least_m = std::min(least_m, (turns[i] + share * leg - p_NE).norm());
  }
  return least_m;
}

/// Root of the mean square of the second difference of the velocity, m/s^3.
double rms_jerk_mps3(const Rows& rows) {
  double sum = 0.0;
  for (size_t i = 1; i + 1 < rows.size(); ++i) {
    const double dt_s = rows[i + 1].t_s - rows[i].t_s;
    sum +=
        ((rows[i + 1].v_WB_W_true - 2.0 * rows[i].v_WB_W_true + rows[i - 1].v_WB_W_true) / (dt_s * dt_s)).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(rows.size() - 2));
}

/// Path of all actuators together, per second, each in its own unit.
double actuator_effort(const Rows& rows) {
  double path = 0.0;
  for (size_t i = 1; i < rows.size(); ++i) path += (rows[i].controls - rows[i - 1].controls).lpNorm<1>();
  return path / (rows.back().t_s - rows.front().t_s);
}

}  // namespace

std::vector<MetricValue> field_metrics(const Scenario& scenario, const Flight& flight, const scenes::Scene& scene,
                                       double vehicle_radius_m) {
  const FlightResult& result = flight.result;
  const Rows& rows = flight.trajectory;
  const Outcome success = scenario.goal ? Outcome::reached : Outcome::timeout;
  std::vector<MetricValue> metrics{{"success", result.outcome == success ? 1.0 : 0.0, ""},
                                   {"collision", result.outcome == Outcome::collided ? 1.0 : 0.0, ""}};
  if (rows.size() < 3) return metrics;
  if (scenario.goal && result.goal_distance_m) {
    const GoalConfig& goal = *scenario.goal;
    const double before_m = (rows.front().p_WB_true - goal.p_WG()).head<2>().norm() - goal.radius_m;
    const double gained_m = before_m - std::max(0.0, *result.goal_distance_m - goal.radius_m);
    if (before_m > 0.0) {
      metrics.push_back({"mission_progress", std::clamp(gained_m / before_m, 0.0, 1.0), ""});
      metrics.push_back({"goal_velocity", gained_m / result.flight_time_s, "m/s"});
    }
    metrics.push_back({"off_course_at_end_m",
                       off_course_m(scenario, rows.front().p_WB_true.head<2>(), rows.back().p_WB_true.head<2>()), "m"});
    if (const auto shortest_m = shortest_free_path_m(goal, rows.front().p_WB_true, scene, vehicle_radius_m)) {
      metrics.push_back({"shortest_path", *shortest_m, "m"});
      if (result.outcome == Outcome::reached && *shortest_m > 0.0) {
        metrics.push_back({"path_excess", result.path_length_m / *shortest_m - 1.0, ""});
      }
    }
  }
  metrics.push_back({"jerk_rms", rms_jerk_mps3(rows), "m/s^3"});
  metrics.push_back({"actuator_effort", actuator_effort(rows), "1/s"});
  return metrics;
}

}  // namespace hedgehop::sim
