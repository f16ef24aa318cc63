#include "sim/verdict/assessment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <variant>

#include "dynamics/rigid_body.h"
#include "sim/fields/quantities.h"
#include "sim/scenario/reference_path.h"
#include "sim/verdict/corridor_truth.h"
#include "sim/verdict/field_metrics.h"
#include "sim/verdict/formula_check.h"
#include "sim/verdict/path_distance.h"

namespace hedgehop::sim {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Inputs of a check.
struct Evidence {
  const Scenario& scenario;
  const Flight& flight;
  const scenes::Scene& scene;
  double rotor_radius_m;

  /// Returns the maximum of a quantity over the control ticks.
  template <class Quantity>
  double maximum(Quantity quantity) const {
    double value = -kInfinity;
    for (const TrajectoryRow& row : flight.trajectory) value = std::max(value, quantity(row));
    return value;
  }
};

const ClosestApproach& closer(const ClosestApproach& a, const ClosestApproach& b) {
  return b.distance_m < a.distance_m ? b : a;
}

std::optional<double> moment(const ClosestApproach& approach) {
  return std::isfinite(approach.distance_m) ? std::optional(approach.t_s) : std::nullopt;
}

CheckResult evaluate(const ReachedGoalCheck& check, const Evidence& e) {
  const FlightResult& result = e.flight.result;
  const std::string name{ReachedGoalCheck::kName};
  if (!e.scenario.goal || !result.goal_distance_m) return {name, false, kNaN, kNaN, "m"};
  const double within_m = check.within_m.value_or(e.scenario.goal->radius_m);
  const double before_s = check.before_s.value_or(e.scenario.duration_s);
  const bool near = *result.goal_distance_m <= within_m;
  if (near && result.outcome != Outcome::reached && !e.flight.trajectory.empty()) {
    const double off_height_m = std::abs((e.flight.trajectory.back().p_WB_true - e.scenario.goal->p_WG()).z());
    const double tolerance_m = e.scenario.goal->height_tolerance_m;
    if (off_height_m > tolerance_m) return {name, false, off_height_m, tolerance_m, "m"};
  }
  if (near && result.flight_time_s > before_s) return {name, false, result.flight_time_s, before_s, "s"};
  return {name, near && result.outcome == Outcome::reached, *result.goal_distance_m, within_m, "m"};
}

CheckResult evaluate(const NoCollisionCheck&, const Evidence& e) {
  const FlightResult& result = e.flight.result;
  const ClosestApproach& nearest = closer(result.closest_obstacle, result.closest_ground);
  return {std::string{NoCollisionCheck::kName},
          result.outcome != Outcome::collided,
          nearest.distance_m,
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
          nearest.distance_m,
          check.at_least_m,
          "m",
          ">=",
          moment(nearest)};
}

CheckResult evaluate(const AltitudeBandCheck& check, const Evidence& e) {
  const double highest_m = e.maximum([](const TrajectoryRow& row) { return -row.p_WB_true.z(); });
  const double lowest_m = -e.maximum([](const TrajectoryRow& row) { return row.p_WB_true.z(); });
  // Reports the side with the smaller margin.
  const bool low_side = lowest_m - check.min_m < check.max_m - highest_m;
  return {std::string{AltitudeBandCheck::kName},
          lowest_m >= check.min_m && highest_m <= check.max_m,
          low_side ? lowest_m : highest_m,
          low_side ? check.min_m : check.max_m,
          "m",
          low_side ? ">=" : "<="};
}

CheckResult evaluate(const InsideBoxCheck& check, const Evidence& e) {
  const double outside_m = e.maximum([&check](const TrajectoryRow& row) {
    return std::max({check.north_min_m - row.p_WB_true.x(), row.p_WB_true.x() - check.north_max_m,
                     check.east_min_m - row.p_WB_true.y(), row.p_WB_true.y() - check.east_max_m});
  });
  return {std::string{InsideBoxCheck::kName}, outside_m <= 0.0, outside_m, 0.0, "m"};
}

CheckResult evaluate(const MaxSpeedCheck& check, const Evidence& e) {
  const double fastest_mps = e.maximum([](const TrajectoryRow& row) { return row.v_WB_W_true.norm(); });
  return {std::string{MaxSpeedCheck::kName}, fastest_mps <= check.at_most_mps, fastest_mps, check.at_most_mps, "m/s"};
}

CheckResult evaluate(const MaxTiltCheck& check, const Evidence& e) {
  constexpr double kDegPerRad = 180.0 / std::numbers::pi;
  const double tilt_rad = e.maximum([](const TrajectoryRow& row) { return dynamics::tilt_rad(row.rpy_true); });
  return {std::string{MaxTiltCheck::kName}, tilt_rad <= check.at_most_rad, tilt_rad * kDegPerRad,
          check.at_most_rad * kDegPerRad, "deg"};
}

CheckResult evaluate(const MetricCheck& check, const Evidence& e) {
  for (const MetricValue& metric : e.flight.result.metrics) {
    if (metric.name != check.name) continue;
    const bool low = check.at_least && !(metric.value >= *check.at_least);
    const bool high = check.at_most && !(metric.value <= *check.at_most);
    const bool shows_minimum = low || !check.at_most;
    const double limit = shows_minimum ? check.at_least.value_or(kNaN) : *check.at_most;
    return {check.name,   !low && !high && std::isfinite(metric.value),
            metric.value, limit,
            metric.unit,  shows_minimum ? ">=" : "<="};
  }
  return {
      check.name, false, kNaN, check.at_least.value_or(check.at_most.value_or(kNaN)), "", check.at_least ? ">=" : "<="};
}

CheckResult evaluate(const FloorVisitedCheck& check, const Evidence& e) {
  std::vector<Eigen::Vector2d> path;
  path.reserve(e.flight.trajectory.size());
  for (const TrajectoryRow& row : e.flight.trajectory) path.emplace_back(row.p_WB_true.head<2>());
  const double share = visited_share(e.scene.bounds_NE_m, check.cell_m, path, e.rotor_radius_m);
  return {std::string{FloorVisitedCheck::kName}, share >= check.at_least, share, check.at_least, "", ">="};
}

CheckResult evaluate(const PathToleranceCheck& check, const Evidence& e) {
  using Measure = PathToleranceCheck::Measure;
  const ReferencePath reference = read_reference_path(check.reference);
  std::vector<TimedPoint> flown;
  for (const TrajectoryRow& row : e.flight.trajectory) flown.push_back({row.t_s, row.p_WB_true});
  const std::string name{PathToleranceCheck::kName};
  if (flown.empty()) return {name, false, kNaN, check.at_most_m, "m"};
  double value_m = kNaN;
  if (check.measure == Measure::band) {
    // A flight may reach its goal early. If it ends elsewhere, the rest of the path is missing.
    constexpr double kRoundedS = 1e-3;  // rounding of the reference's times
    const double early_s = reference.points.back().t_s - flown.back().t_s;
    if (early_s > kRoundedS && e.flight.result.outcome != Outcome::reached) {
      return {name, false, flown.back().t_s, reference.points.back().t_s, "s", ">="};
    }
    value_m = max_deviation_m(flown, reference.points);
  } else {
    const std::vector<TimedPoint> coarse = thinned(flown, reference.step_s);
    value_m = check.measure == Measure::frechet ? discrete_frechet_m(coarse, reference.points)
                                                : mean_warped_distance_m(coarse, reference.points);
    // The mean alone would not show that the end of the path is missing.
    const double ends_apart_m = (flown.back().p_WB - reference.points.back().p_WB).norm();
    if (ends_apart_m > check.at_most_m) value_m = std::max(value_m, ends_apart_m);
  }
  return {name, value_m <= check.at_most_m, value_m, check.at_most_m, "m"};
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

double visited_share(const Eigen::AlignedBox2d& plan_NE_m, double cell_m, const std::vector<Eigen::Vector2d>& path_NE_m,
                     double disc_radius_m) {
  const Eigen::Vector2i cells = (plan_NE_m.sizes() / cell_m).array().ceil().cast<int>();
  std::vector<char> visited(static_cast<size_t>(cells.x()) * static_cast<size_t>(cells.y()), 0);
  const auto cell_range = [&](double center_m, double origin_m, int count) {
    const int first = static_cast<int>(std::floor((center_m - disc_radius_m - origin_m) / cell_m));
    const int last = static_cast<int>(std::ceil((center_m + disc_radius_m - origin_m) / cell_m));
    return std::pair{std::clamp(first, 0, count), std::clamp(last, 0, count)};
  };
  for (const Eigen::Vector2d& p : path_NE_m) {
    const auto [row_begin, row_end] = cell_range(p.x(), plan_NE_m.min().x(), cells.x());
    const auto [col_begin, col_end] = cell_range(p.y(), plan_NE_m.min().y(), cells.y());
    for (int row = row_begin; row < row_end; ++row) {
      for (int col = col_begin; col < col_end; ++col) {
        const Eigen::Vector2d center = plan_NE_m.min() + cell_m * Eigen::Vector2d(row + 0.5, col + 0.5);
        if ((center - p).norm() <= disc_radius_m) visited[static_cast<size_t>(row * cells.y() + col)] = 1;
      }
    }
  }
  const auto count = std::count(visited.begin(), visited.end(), 1);
  return visited.empty() ? 0.0 : static_cast<double>(count) / static_cast<double>(visited.size());
}

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
}

}  // namespace hedgehop::sim
