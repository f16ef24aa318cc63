#include "tests/sim/record/fake_flight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace hedgehop::sim {
namespace {

constexpr double kAltitudeM = 10.0;

/// Returns the horizontal distance to the nearest box minus the radius of the hull.
double distance_m(const std::vector<scenes::Solid>& city, const Eigen::Vector3d& p_W, std::string& name) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const scenes::Solid& solid : city) {
    const Eigen::Vector3d p_S = solid.X_WS.inverse() * p_W;
    const double d = (p_S.cwiseAbs() - solid.half_extents_m).cwiseMax(0.0).norm() - 0.9;
    if (d < nearest) name = solid.name;
    nearest = std::min(nearest, d);
  }
  return nearest;
}

/// Returns a path along a street, then a slalom to the goal.
Eigen::Vector3d path_W(double share) {
  const Eigen::Vector2d start(-130.0, 80.0), goal(110.0, -110.0);
  const Eigen::Vector2d along = (goal - start).normalized(), across(-along.y(), along.x());
  const double weave_m = 14.0 * std::sin(9.0 * share) * share * (1.0 - share) * 4.0;
  const Eigen::Vector2d p = start + share * (goal - start) + weave_m * across;
  return {p.x(), p.y(), -kAltitudeM + 0.3 * std::sin(40.0 * share)};
}

TrajectoryRow row_at(double t_s, double seconds, std::mt19937_64& random) {
  std::normal_distribution<double> noise(0.0, 1.0);
  const auto jitter = [&](double sigma) -> Eigen::Vector3d {
    return Eigen::Vector3d(noise(random), noise(random), noise(random)) * sigma;
  };
  const double h_s = 0.01;
  TrajectoryRow row;
  row.t_s = t_s;
  row.p_WB_true = path_W(t_s / seconds);
  row.v_WB_W_true = (path_W((t_s + h_s) / seconds) - path_W((t_s - h_s) / seconds)) / (2.0 * h_s);
  row.rpy_true = {0.05 * std::sin(t_s), -0.04 + 0.02 * std::cos(0.7 * t_s),
                  0.02 * std::sin(0.1 * t_s) + std::numbers::pi};
  if (row.rpy_true.z() > std::numbers::pi) row.rpy_true.z() -= 2.0 * std::numbers::pi;
  row.w_WB_B_true = jitter(0.01);
  row.p_WB_est = row.p_WB_true + Eigen::Vector3d(std::sin(0.05 * t_s), 0.4 * std::cos(0.08 * t_s), 0.0) + jitter(0.02);
  row.rpy_est = row.rpy_true + jitter(0.002);
  row.v_WB_W_est = row.v_WB_W_true + jitter(0.04);
  row.v_WB_W_cmd = row.v_WB_W_true.head<2>() +
                   0.3 * Eigen::Vector2d(std::sin(std::floor(3.0 * t_s)), std::cos(std::floor(2.0 * t_s)));
  row.altitude_cmd_m = kAltitudeM;
  row.heading_cmd_rad = std::numbers::pi;
  row.ground_clearance_m = -row.p_WB_true.z() - 0.6;
  row.controls[0] = 0.09 + 0.004 * noise(random);
  row.controls[1] = 0.01 * std::sin(t_s);
  row.controls[2] = -0.02 + 0.003 * noise(random);
  row.controls[3] = 0.05 + 0.01 * std::sin(2.0 * t_s);
  row.wind_W = Eigen::Vector3d(2.0, -1.0, 0.0) + 0.5 * Eigen::Vector3d(std::sin(0.9 * t_s), std::cos(1.3 * t_s), 0.2);
  row.range_m = 20.0 + std::sin(0.4 * t_s);
  return row;
}

void log_decisions(Flight& flight, std::mt19937_64& random) {
  std::normal_distribution<double> noise(0.0, 1.0);
  for (const std::string what : {"flow", "loom"}) {
    for (const std::string camera : {"left", "right", "front", "rear"}) {
      flight.signals.push_back({what + "_" + camera + (what == "flow" ? "_radps" : "_per_s"), ""});
    }
  }
  flight.signals.push_back({"goal_distance_m", "m"});
  for (size_t i = 0; i < flight.trajectory.size(); i += 4) {
    const TrajectoryRow& row = flight.trajectory[i];
    const double near = 1.0 / std::max(0.5, row.obstacle_clearance_m);
    DecisionRow decision{.t_s = row.t_s,
                         .status = near > 0.25 ? "avoid" : "cruise",
                         .v_WB_W_cmd = row.v_WB_W_cmd,
                         .altitude_cmd_m = row.altitude_cmd_m,
                         .heading_cmd_rad = row.heading_cmd_rad};
    for (int camera = 0; camera < 8; ++camera) {
      const double value = (camera < 4 ? 0.8 : 0.3) * near * std::cos(camera + 0.1 * row.t_s) + 0.02 * noise(random);
      decision.signals.push_back(i % 400 == 0 ? std::numeric_limits<double>::quiet_NaN() : value);
    }
    decision.signals.push_back((row.p_WB_true.head<2>() - Eigen::Vector2d(110.0, -110.0)).norm());
    flight.decisions.push_back(decision);
  }
}

void judge(Flight& flight) {
  FlightResult& r = flight.result;
  r.outcome = Outcome::reached;
  r.flight_time_s = flight.trajectory.back().t_s;
  for (size_t i = 1; i < flight.trajectory.size(); ++i) {
    r.path_length_m += (flight.trajectory[i].p_WB_true - flight.trajectory[i - 1].p_WB_true).norm();
  }
  r.mean_speed_mps = r.path_length_m / r.flight_time_s;
  r.goal_distance_m = (flight.trajectory.back().p_WB_true.head<2>() - Eigen::Vector2d(110.0, -110.0)).norm();
  r.decisions = static_cast<int64_t>(flight.decisions.size());
  r.decision_ms = {6.21, 7.9};
  r.render_ms = {11.4, 14.02};
  r.velocimeter_ms = {1.5, 1.9};
  r.physics_ms = {0.004, 0.009};
  r.realtime_factor = 1.31;
  r.wall_s = r.flight_time_s / r.realtime_factor;
  const double nearest_m = r.closest_obstacle.distance_m;
  r.checks = {{"reached_goal", true, *r.goal_distance_m, 5.0, "m"},
              {"no_collision", true, nearest_m, std::numeric_limits<double>::quiet_NaN(), "m"},
              {"min_clearance", nearest_m >= 1.5, nearest_m, 1.5, "m"}};
  r.trajectory_hash = "0123456789abcdef";
  r.metrics = {{"valid_share", 0.93, ""}, {"largest_flow", 1.234, "rad/s"}};
}

}  // namespace

std::vector<scenes::Solid> fake_city(uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> side(8.0, 13.0), shift(-3.0, 3.0), height(8.0, 40.0), turn(-0.1, 0.1);
  std::vector<scenes::Solid> city;
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 8; ++column) {
      scenes::Solid solid{.name = "building_" + std::to_string(city.size())};
      solid.half_extents_m = {side(random), side(random), height(random) / 2.0};
      solid.X_WS.translation() = Eigen::Vector3d(-122.5 + 35.0 * row + shift(random),
                                                 -122.5 + 35.0 * column + shift(random), -solid.half_extents_m.z());
      solid.X_WS.linear() = Eigen::AngleAxisd(turn(random), Eigen::Vector3d::UnitZ()).toRotationMatrix();
      std::string ignored;
      bool in_the_way = false;
      for (double share = 0.0; share <= 1.0; share += 0.002)
        in_the_way |= distance_m({solid}, path_W(share), ignored) < 1.0;
      if (!in_the_way) city.push_back(solid);
    }
  }
  return city;
}

Flight fake_flight(double seconds, uint64_t seed) {
  std::mt19937_64 random(seed);
  const std::vector<scenes::Solid> city = fake_city(seed);
  Flight flight;
  flight.control_names = {"collective_rad", "lateral_rad", "longitudinal_rad", "tail_rad"};
  ClosestApproach& obstacle = flight.result.closest_obstacle;
  ClosestApproach& ground = flight.result.closest_ground;
  obstacle.distance_m = ground.distance_m = std::numeric_limits<double>::infinity();
  for (int64_t tick = 0; static_cast<double>(tick) <= seconds * 100.0; ++tick) {
    TrajectoryRow row = row_at(static_cast<double>(tick) * 0.01, seconds, random);
    std::string name;
    row.obstacle_clearance_m = distance_m(city, row.p_WB_true, name);
    if (row.obstacle_clearance_m < obstacle.distance_m)
      obstacle = {row.obstacle_clearance_m, row.t_s, name, row.p_WB_true};
    if (row.ground_clearance_m < ground.distance_m) ground = {row.ground_clearance_m, row.t_s, "ground", row.p_WB_true};
    flight.trajectory.push_back(row);
  }
  log_decisions(flight, random);
  judge(flight);
  return flight;
}

}  // namespace hedgehop::sim
