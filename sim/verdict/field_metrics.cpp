#include "sim/verdict/field_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dynamics/rigid_body.h"
#include "sim/collision/disc_clearance.h"
#include "sim/collision/proximity.h"
#include "sim/verdict/shortest_path.h"

namespace hedgehop::sim {
namespace {

/// Advances in steps of clearance over maximum closing speed, so that no contact is missed.
std::optional<double> time_to_collision_s(CollisionWorld& world, const scenes::Scene& scene, Eigen::Isometry3d X_WB,
                                          const Eigen::Vector3d& v_WB_W, double t_s, double horizon_s) {
  constexpr double kContactM = 1e-3, kMinSpeedMps = 1e-3, kMinStepS = 1e-4, kMaxStepS = 0.1;
  const Eigen::Vector3d start_W = X_WB.translation();
  for (double after_s = 0.0; after_s <= horizon_s;) {
    double mover_mps = 0.0;
    for (const scenes::Mover& mover : scene.movers) {
      mover_mps = std::max(mover_mps, scenes::max_speed_mps(mover.motion, scenes::reach_m(mover), t_s + after_s));
    }
    const double closing_mps = std::max(kMinSpeedMps, v_WB_W.norm() + mover_mps);
    X_WB.translation() = start_W + after_s * v_WB_W;
    const double reach_m = closing_mps * horizon_s + kContactM;
    const double clearance_m = world.query(X_WB, reach_m, t_s + after_s).obstacle_clearance_m;
    if (clearance_m <= kContactM) return after_s;
    // A mover may start during the step, so steps are short in scenes with movers.
    const double step_s = std::max(kMinStepS, clearance_m / closing_mps);
    after_s += scene.movers.empty() ? step_s : std::min(step_s, kMaxStepS);
  }
  return {};
}

}  // namespace

std::optional<double> time_to_collision_s(const scenes::Scene& scene, const std::vector<dynamics::HullPart>& hull,
                                          const Eigen::Isometry3d& X_WB, const Eigen::Vector3d& v_WB_W, double t_s,
                                          double horizon_s) {
  CollisionWorld world(scene, hull);
  return time_to_collision_s(world, scene, X_WB, v_WB_W, t_s, horizon_s);
}

std::optional<double> time_to_collision_at_reaction_s(const Flight& flight, const scenes::Scene& scene,
                                                      const std::vector<dynamics::HullPart>& hull) {
  constexpr double kHorizonS = 10.0, kSameTickS = 1e-6;
  const bool collided = flight.result.outcome == Outcome::collided;
  std::optional<double> min_s;
  bool predicted = false;  // a collision, by a reaction within kHorizonS before the end
  CollisionWorld world(scene, hull);
  for (size_t i = 1; i < flight.decisions.size(); ++i) {
    const DecisionRow& decision = flight.decisions[i];
    if (decision.status == "cruise" || decision.status == flight.decisions[i - 1].status) continue;
    const double effect_s = decision.t_s + flight.command_latency_s;
    const auto row = std::ranges::lower_bound(flight.trajectory, effect_s - kSameTickS, {}, &TrajectoryRow::t_s);
    if (row == flight.trajectory.end()) break;  // the flight ended before
    Eigen::Isometry3d X_WB(dynamics::from_roll_pitch_heading(row->rpy_true.x(), row->rpy_true.y(), row->rpy_true.z()));
    X_WB.translation() = row->p_WB_true;
    const auto left_s = time_to_collision_s(world, scene, X_WB, row->v_WB_W_true, row->t_s, kHorizonS);
    if (!left_s) continue;
    min_s = std::min(*left_s, min_s.value_or(kHorizonS));
    predicted = predicted || row->t_s >= flight.result.flight_time_s - kHorizonS;
  }
  if (collided && !predicted) return 0.0;
  return min_s;
}

namespace {

using Rows = std::vector<TrajectoryRow>;

/// Returns the length of the shortest free path from the start to the goal's circle for a disc of the vehicle's radius
/// at the goal's altitude, m.
std::optional<double> shortest_free_path_m(const GoalConfig& goal, const Eigen::Vector3d& start_W,
                                           const scenes::Scene& scene, double vehicle_radius_m) {
  constexpr double kHalfThicknessM = 0.05, kMinCellM = 0.25, kMaxCells = 1000.0, kMarginM = 5.0, kReachM = 8.0;
  Eigen::AlignedBox2d bounds = scene.bounds_NE_m;
  bounds.extend(Eigen::Vector2d(start_W.head<2>())).extend(Eigen::Vector2d(goal.p_WG().head<2>()));
  bounds = {bounds.min().array() - kMarginM, bounds.max().array() + kMarginM};
  const double cell_m = std::max(kMinCellM, bounds.sizes().maxCoeff() / kMaxCells);
  DiscClearance disc(scene, {vehicle_radius_m, kHalfThicknessM, -goal.p_WG().z()}, bounds, kReachM);
  const auto clearance_m = [&](const Eigen::Vector2d& p_NE_m) { return disc.at(p_NE_m); };
  return shortest_path_m(start_W.head<2>(), {goal.p_WG().head<2>(), goal.radius_m}, bounds, cell_m, clearance_m);
}

/// Returns the horizontal distance from the polyline of start, route and goal, m.
double off_course_m(const Scenario& scenario, const Eigen::Vector2d& start_NE, const Eigen::Vector2d& p_NE) {
  std::vector<Eigen::Vector2d> course{start_NE};
  for (const GoalConfig& waypoint : scenario.route) course.emplace_back(waypoint.p_WG().head<2>());
  course.emplace_back(scenario.goal->p_WG().head<2>());
  double distance_m = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i + 1 < course.size(); ++i) {
    const Eigen::Vector2d leg = course[i + 1] - course[i];
    const double share = std::clamp((p_NE - course[i]).dot(leg) / std::max(leg.squaredNorm(), 1e-12), 0.0, 1.0);
    distance_m = std::min(distance_m, (course[i] + share * leg - p_NE).norm());
  }
  return distance_m;
}

/// Returns the RMS jerk from second differences of the velocity, m/s^3.
double rms_jerk_mps3(const Rows& rows) {
  double sum = 0.0;
  for (size_t i = 1; i + 1 < rows.size(); ++i) {
    const double dt_s = rows[i + 1].t_s - rows[i].t_s;
    sum +=
        ((rows[i + 1].v_WB_W_true - 2.0 * rows[i].v_WB_W_true + rows[i - 1].v_WB_W_true) / (dt_s * dt_s)).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(rows.size() - 2));
}

/// Returns the total travel of all actuators per second, each in its own unit.
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
  if (scenario.collision_of == CollisionOf::center) {
    metrics.push_back({"center_collision", metrics.back().value, ""});
    metrics.push_back({"hull_collision", closest_approach(result).distance_m <= 0.0 ? 1.0 : 0.0, ""});
  }
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
