#include "sim/verdict/assessment.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "dynamics/rigid_body.h"
#include "sim/fields/quantities.h"
#include "sim/verdict/corridor_truth.h"
#include "sim/verdict/field_metrics.h"
#include "sim/verdict/flight_cause.h"
#include "sim/verdict/floor_visited.h"
#include "sim/verdict/formula_check.h"
#include "sim/verdict/path_check.h"

namespace hedgehop::sim {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// An extreme value of a flight; no time without a trajectory.
struct Extreme {
  double value = -kInfinity;
  std::optional<double> t_s;
};

/// Inputs of a check.
struct Evidence {
  const Scenario& scenario;
  const Flight& flight;
  const scenes::Scene& scene;
  double rotor_radius_m;

  /// Returns the maximum of a quantity over the control ticks, and its time.
  template <class Quantity>
  Extreme maximum(Quantity quantity) const {
    Extreme extreme;
    for (const TrajectoryRow& row : flight.trajectory) {
      if (const double value = quantity(row); value > extreme.value) extreme = {value, row.t_s};
    }
    return extreme;
  }
};

const ClosestApproach& closer(const ClosestApproach& a, const ClosestApproach& b) {
  return b.distance_m < a.distance_m ? b : a;
}

std::string name_of(const ClosestApproach& approach) {
  return approach.what.empty() ? "an obstacle" : approach.what == "ground" ? "the ground" : approach.what;
}

/// Returns a clearance as far as it is known, m.
double known_m(const ClosestApproach& approach) { return std::min(approach.distance_m, kMaxClearanceM); }

std::optional<double> moment(const ClosestApproach& approach) {
  return std::isfinite(approach.distance_m) ? std::optional(approach.t_s) : std::nullopt;
}

/// Returns the closest approach to the goal in words.
std::string closest_to_goal(const Evidence& e) {
  const Extreme closest =
      e.maximum([&](const TrajectoryRow& row) { return -(row.p_WB_true - e.scenario.goal->p_WG()).head<2>().norm(); });
  if (!closest.t_s) return "";
  return fmt::format("distance at the end; minimum {:.1f} m at {:.1f} s", -closest.value, *closest.t_s);
}

/// A failed reached_goal shows the figure that fails, never one that satisfies its bound.
CheckResult evaluate(const ReachedGoalCheck& check, const Evidence& e) {
  const FlightResult& result = e.flight.result;
  const std::string name{ReachedGoalCheck::kName};
  if (!e.scenario.goal || !result.goal_distance_m) return {name, false, kNaN, kNaN, "m", "<=", {}, "there is no goal"};
  const double within_m = check.within_m.value_or(e.scenario.goal->radius_m);
  const double before_s = check.before_s.value_or(e.scenario.duration_s);
  const bool near = *result.goal_distance_m <= within_m;
  if (near && result.outcome != Outcome::reached && !e.flight.trajectory.empty()) {
    const double off_height_m = std::abs((e.flight.trajectory.back().p_WB_true - e.scenario.goal->p_WG()).z());
    const double tolerance_m = e.scenario.goal->height_tolerance_m;
    if (off_height_m > tolerance_m)
      return {name, false, off_height_m, tolerance_m, "m", "<=", {}, "altitude difference to the goal at the end"};
  }
  if (near && result.flight_time_s > before_s)
    return {name, false, result.flight_time_s, before_s, "s", "<=", {}, "time at the goal"};
  if (near && result.outcome == Outcome::collided) {
    const ClosestApproach& nearest = closer(result.closest_obstacle, result.closest_ground);
    return {name, false, nearest.distance_m, 0.0, "m", ">", moment(nearest), "clearance: collision at the goal"};
  }
  if (near && result.outcome == Outcome::fault)
    return {name, false, kNaN, within_m, "m", "<=", {}, "the flight ended with a fault at the goal"};
  if (near && result.outcome == Outcome::timeout && !e.scenario.route.empty())
    return {name, false, kNaN, within_m, "m", "<=", {}, "the route before the goal was not completed"};
  return {name, near, *result.goal_distance_m, within_m, "m", "<=", {}, near ? "" : closest_to_goal(e)};
}

CheckResult evaluate(const NoCollisionCheck&, const Evidence& e) {
  const FlightResult& result = e.flight.result;
  const ClosestApproach& nearest = closer(result.closest_obstacle, result.closest_ground);
  const bool hull_passes_through = e.scenario.collision_of == CollisionOf::center && nearest.distance_m <= 0.0;
  return {std::string{NoCollisionCheck::kName},
          result.outcome != Outcome::collided && !hull_passes_through,
          known_m(nearest),
          0.0,
          "m",
          ">",
          moment(nearest)};
}

CheckResult evaluate(const MinClearanceCheck& check, const Evidence& e) {
  using To = MinClearanceCheck::To;
  const ClosestApproach &obstacle = e.flight.result.closest_obstacle, &ground = e.flight.result.closest_ground;
  const ClosestApproach& nearest = check.to == To::obstacles ? obstacle
                                   : check.to == To::ground  ? ground
                                                             : closer(obstacle, ground);
  return {std::string{MinClearanceCheck::kName},
          nearest.distance_m >= check.at_least_m,
          check.to == To::ground ? nearest.distance_m : known_m(nearest),
          check.at_least_m,
          "m",
          ">=",
          moment(nearest),
          nearest.distance_m >= check.at_least_m ? "" : "to " + name_of(nearest)};
}

CheckResult evaluate(const AltitudeBandCheck& check, const Evidence& e) {
  const Extreme highest = e.maximum([](const TrajectoryRow& row) { return -row.p_WB_true.z(); });
  const Extreme lowest = e.maximum([](const TrajectoryRow& row) { return row.p_WB_true.z(); });
  const double highest_m = highest.value, lowest_m = -lowest.value;
  // Reports the side with the smaller margin.
  const bool low_side = lowest_m - check.min_m < check.max_m - highest_m;
  return {std::string{AltitudeBandCheck::kName},
          lowest_m >= check.min_m && highest_m <= check.max_m,
          low_side ? lowest_m : highest_m,
          low_side ? check.min_m : check.max_m,
          "m",
          low_side ? ">=" : "<=",
          low_side ? lowest.t_s : highest.t_s};
}

CheckResult evaluate(const InsideBoxCheck& check, const Evidence& e) {
  const Extreme outside = e.maximum([&check](const TrajectoryRow& row) {
    return std::max({check.north_min_m - row.p_WB_true.x(), row.p_WB_true.x() - check.north_max_m,
                     check.east_min_m - row.p_WB_true.y(), row.p_WB_true.y() - check.east_max_m});
  });
  return {std::string{InsideBoxCheck::kName}, outside.value <= 0.0, outside.value, 0.0, "m", "<=", outside.t_s};
}

CheckResult evaluate(const MaxSpeedCheck& check, const Evidence& e) {
  const Extreme fastest = e.maximum([](const TrajectoryRow& row) { return row.v_WB_W_true.norm(); });
  return {std::string{MaxSpeedCheck::kName},
          fastest.value <= check.at_most_mps,
          fastest.value,
          check.at_most_mps,
          "m/s",
          "<=",
          fastest.t_s};
}

CheckResult evaluate(const MaxTiltCheck& check, const Evidence& e) {
  const Extreme tilt = e.maximum([](const TrajectoryRow& row) { return dynamics::tilt_rad(row.rpy_true); });
  return {std::string{MaxTiltCheck::kName},
          tilt.value <= check.at_most_rad,
          tilt.value * kDegPerRad,
          check.at_most_rad * kDegPerRad,
          "deg",
          "<=",
          tilt.t_s};
}

/// Returns why a metric has no value.
std::string absent_words(const std::string& name, const std::vector<MetricValue>& metrics) {
  if (!name.starts_with(kModulePrefix)) return "the metric does not apply to this flight";
  std::vector<std::string_view> names;
  for (const MetricValue& metric : metrics)
    if (metric.name.starts_with(kModulePrefix)) names.push_back(metric.name);
  return fmt::format("the flight has no such metric; this module has: {}",
                     names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")));
}

CheckResult evaluate(const MetricCheck& check, const Evidence& e) {
  for (const MetricValue& metric : e.flight.result.metrics) {
    if (metric.name != check.name) continue;
    const bool low = check.at_least && !(metric.value >= *check.at_least);
    const bool high = check.at_most && !(metric.value <= *check.at_most);
    // Reports the side with the smaller margin.
    const bool shows_minimum =
        low || !check.at_most || (check.at_least && metric.value - *check.at_least < *check.at_most - metric.value);
    const double limit = shows_minimum ? check.at_least.value_or(kNaN) : *check.at_most;
    return {check.name,   !low && !high && std::isfinite(metric.value),
            metric.value, limit,
            metric.unit,  shows_minimum ? ">=" : "<="};
  }
  return {.name = check.name,
          .value = kNaN,
          .limit = check.at_least.value_or(check.at_most.value_or(kNaN)),
          .unit = {},
          .must = check.at_least ? ">=" : "<=",
          .t_s = {},
          .cause = absent_words(check.name, e.flight.result.metrics)};
}

CheckResult evaluate(const FloorVisitedCheck& check, const Evidence& e) {
  std::vector<Eigen::Vector2d> path;
  path.reserve(e.flight.trajectory.size());
  for (const TrajectoryRow& row : e.flight.trajectory) path.emplace_back(row.p_WB_true.head<2>());
  const double share = visited_share(e.scene.bounds_NE_m, check.cell_m, path, e.rotor_radius_m);
  return {std::string{FloorVisitedCheck::kName}, share >= check.at_least, share, check.at_least, "", ">="};
}

CheckResult evaluate(const PathToleranceCheck& check, const Evidence& e) {
  return evaluate_path(check, e.flight, e.scenario.seed);
}

CheckResult evaluate(const FormulaCheck& check, const Evidence& e) {
  return evaluate_formula(check, e.scenario, e.flight);
}

CheckResult evaluate(const NoTruthUsedCheck&, const Evidence& e) {
  const auto used = static_cast<double>(e.flight.result.truth_used.size());
  return {std::string{NoTruthUsedCheck::kName}, used == 0.0, used, 0.0, ""};
}

CheckResult evaluate(const RealtimeFactorCheck& check, const Evidence& e) {
  const double factor = e.flight.result.realtime_factor;
  return {std::string{RealtimeFactorCheck::kName}, factor >= check.at_least, factor, check.at_least, "", ">="};
}

}  // namespace

std::vector<CheckResult> evaluate_checks(const Scenario& scenario, const Flight& flight, const scenes::Scene& scene,
                                         double rotor_radius_m) {
  const Evidence evidence{scenario, flight, scene, rotor_radius_m};
  std::vector<CheckResult> results;
  bool forbids_collision = false;
  for (const CheckConfig& check : scenario.checks) {
    const bool repeated = forbids_collision && std::holds_alternative<NoCollisionCheck>(check);
    forbids_collision = forbids_collision || std::holds_alternative<NoCollisionCheck>(check);
    if (repeated) continue;
    results.push_back(std::visit([&evidence](const auto& c) { return evaluate(c, evidence); }, check));
  }
  if (!forbids_collision && !scenario.may_collide) results.push_back(evaluate(NoCollisionCheck{}, evidence));
  return results;
}

namespace {

/// Returns the maximum radius of the upright discs of a hull, m; 0 without a disc.
double rotor_radius_m(const std::vector<dynamics::HullPart>& hull) {
  double radius_m = 0.0;
  for (const dynamics::HullPart& part : hull) {
    if (part.shape == dynamics::HullPart::Shape::cylinder) radius_m = std::max(radius_m, part.half_extents_m.x());
  }
  return radius_m;
}

}  // namespace

void assess(const Scenario& scenario, const scenes::Scene& scene, const std::vector<dynamics::HullPart>& hull,
            Flight& flight) {
  constexpr double kAboutStartM = 1.0;
  const double altitude_m = scenario.start.altitude_m;
  flight.result.scene = scenes::scene_figures(scene, {altitude_m - kAboutStartM, altitude_m + kAboutStartM});
  for (MetricValue& metric : field_metrics(scenario, flight, scene, dynamics::radius_m(hull))) {
    flight.result.metrics.push_back(std::move(metric));
  }
  if (const auto left_s = time_to_collision_at_reaction_s(flight, scene, hull)) {
    flight.result.metrics.push_back({"time_to_collision_at_reaction_s", *left_s, "s"});
  }
  for (const MetricValue& metric : corridor_metrics(scenario, flight)) flight.result.metrics.push_back(metric);
  flight.result.checks = evaluate_checks(scenario, flight, scene, rotor_radius_m(hull));
  explain(scenario, flight);
}

}  // namespace hedgehop::sim
