#include "sim/verdict/formula_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hedgehop::sim {
namespace {

constexpr double kFarthestM = 50.0;  // farther solids count as absent; finite, so that sums of signals are

double degrees(double angle_rad) { return 180.0 / std::numbers::pi * angle_rad; }

double wrapped_deg(double angle_rad) { return degrees(std::remainder(angle_rad, 2.0 * std::numbers::pi)); }

double tilt_rad(const Eigen::Vector3d& rpy) {
  return std::acos(std::clamp(std::cos(rpy.x()) * std::cos(rpy.y()), -1.0, 1.0));
}

void add_motion(const TrajectoryRow& row, const Scenario& scenario, SampledSignals& signals) {
  const auto add = [&](const char* name, double value) { signals.numbers[name].push_back(value); };
  add("north", row.p_WB_true.x());
  add("east", row.p_WB_true.y());
  add("altitude", -row.p_WB_true.z());
  add("speed", row.v_WB_W_true.norm());
  add("climb", -row.v_WB_W_true.z());
  add("roll", degrees(row.rpy_true.x()));
  add("pitch", degrees(row.rpy_true.y()));
  add("heading", wrapped_deg(row.rpy_true.z()));
  add("tilt", degrees(tilt_rad(row.rpy_true)));
  add("wind", row.wind_W.norm());
  const Eigen::Vector2d v_NE = row.v_WB_W_true.head<2>();
  add("tracking_error", row.v_WB_W_cmd ? (*row.v_WB_W_cmd - v_NE).norm() : 0.0);
  add("estimation_error", (row.p_WB_est - row.p_WB_true).norm());
  add("goal_distance", scenario.goal ? (row.p_WB_true - scenario.goal->p_WG()).head<2>().norm() : 0.0);
}

/// Distances at the ticks, and the closest one wherever it fell between them.
std::vector<double> clearances(const Flight& flight, double TrajectoryRow::*distance_m, const ClosestApproach& closest,
                               double dt_s) {
  std::vector<double> values;
  for (const TrajectoryRow& row : flight.trajectory) values.push_back(std::min(row.*distance_m, kFarthestM));
  if (values.empty() || !(closest.distance_m < kFarthestM)) return values;
  constexpr double kRoundOff = 1e-9;
  const auto sample = static_cast<size_t>(std::max(0.0, std::floor(closest.t_s / dt_s + kRoundOff)));
  double& value = values[std::min(sample, values.size() - 1)];
  value = std::min(value, closest.distance_m);
  return values;
}

/// The status in force at each row: that of the last decision.
std::vector<std::string> status_words(const Flight& flight) {
  std::vector<std::string> words;
  auto next = flight.decisions.begin();
  for (const TrajectoryRow& row : flight.trajectory) {
    while (next != flight.decisions.end() && next->t_s <= row.t_s) ++next;
    words.push_back(next == flight.decisions.begin() ? "" : std::prev(next)->status);
  }
  return words;
}

}  // namespace

SampledSignals flight_signals(const Scenario& scenario, const Flight& flight) {
  SampledSignals signals{.dt_s = 1.0 / static_cast<double>(scenario.control_rate_hz),
                         .samples = flight.trajectory.size(),
                         .numbers = {},
                         .status = status_words(flight)};
  for (const TrajectoryRow& row : flight.trajectory) add_motion(row, scenario, signals);
  const FlightResult& result = flight.result;
  const std::vector<double> obstacle =
      clearances(flight, &TrajectoryRow::obstacle_clearance_m, result.closest_obstacle, signals.dt_s);
  const std::vector<double> ground =
      clearances(flight, &TrajectoryRow::ground_clearance_m, result.closest_ground, signals.dt_s);
  std::vector<double>& nearest = signals.numbers["clearance"];
  for (size_t i = 0; i < obstacle.size(); ++i) nearest.push_back(std::min(obstacle[i], ground[i]));
  signals.numbers["obstacle_clearance"] = obstacle;
  signals.numbers["ground_clearance"] = ground;
  return signals;
}

CheckResult evaluate_formula(const FormulaCheck& check, const Scenario& scenario, const Flight& flight) {
  const SampledSignals signals = flight_signals(scenario, flight);
  CheckResult result{check.name, false, std::numeric_limits<double>::quiet_NaN(), 0.0, "", ">="};
  if (signals.samples == 0) return result;
  const Robustness r = robustness(parse_formula(check.formula), signals);
  result.value = r.value[0];
  result.passed = result.value >= 0.0;
  result.t_s = flight.trajectory[r.decisive[0]].t_s;
  return result;
}

}  // namespace hedgehop::sim
