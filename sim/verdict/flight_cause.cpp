#include "sim/verdict/flight_cause.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "sim/fields/quantities.h"
#include "sim/flight/words.h"

namespace hedgehop::sim {
namespace {

constexpr double kLastS = 10.0;    // stretch that is described if the status changes in it
constexpr double kTellingS = 3.0;  // a status held this long describes the end by itself

struct LastStretch {
  double from_s = 0.0;
  std::string statuses;
};

/// Returns a length or time with two figures.
std::string rounded(double value) { return value < 9.95 ? fmt::format("{:.1f}", value) : fmt::format("{:.0f}", value); }

std::string quoted(const std::string& status) { return status.empty() ? "no status" : "`" + status + "`"; }

/// Returns the share of time of each status from a time on, the largest first.
std::vector<std::pair<double, std::string>> shares(const std::vector<DecisionRow>& decisions, double from_s,
                                                   double end_s) {
  std::vector<std::pair<double, std::string>> all;
  for (size_t i = 0; i < decisions.size(); ++i) {
    const double until_s = i + 1 < decisions.size() ? decisions[i + 1].t_s : end_s;
    const double held_s = until_s - std::max(from_s, decisions[i].t_s);
    if (held_s <= 0.0) continue;
    const auto same = std::ranges::find(all, decisions[i].status, &std::pair<double, std::string>::second);
    if (same == all.end()) {
      all.emplace_back(held_s, decisions[i].status);
    } else {
      same->first += held_s;
    }
  }
  std::ranges::stable_sort(all, std::greater{}, &std::pair<double, std::string>::first);
  return all;
}

LastStretch last_stretch(const std::vector<DecisionRow>& decisions, double end_s) {
  const auto changed = std::find_if(decisions.rbegin(), decisions.rend(),
                                    [&](const DecisionRow& row) { return row.status != decisions.back().status; });
  const double since_s = changed == decisions.rend() ? decisions.front().t_s : changed.base()->t_s;
  if (changed == decisions.rend() || end_s - since_s >= kTellingS) {
    return {since_s, quoted(decisions.back().status)};
  }
  const double from_s = std::max(decisions.front().t_s, end_s - kLastS);
  std::vector<std::string> words;
  for (const auto& [held_s, status] : shares(decisions, from_s, end_s)) {
    constexpr size_t kMaxStatuses = 3;
    if (words.size() < kMaxStatuses)
      words.push_back(fmt::format("{} ({:.0f} %)", quoted(status), 100.0 * held_s / (end_s - from_s)));
  }
  return {from_s, fmt::format("{}", fmt::join(words, ", "))};
}

/// Returns the commanded speeds from a time on: "0 m/s", "0.3 to 1.2 m/s"; "no velocity" if no decision has one.
std::string commanded_words(const std::vector<DecisionRow>& decisions, double from_s) {
  constexpr double kEqualMps = 0.1;
  double least_mps = kInfinity, most_mps = -kInfinity;
  for (const DecisionRow& row : decisions) {
    if (row.t_s < from_s || !row.v_WB_W_cmd) continue;
    least_mps = std::min(least_mps, row.v_WB_W_cmd->norm());
    most_mps = std::max(most_mps, row.v_WB_W_cmd->norm());
  }
  if (most_mps < least_mps) return "no velocity";
  const auto words = [](double speed_mps) { return speed_mps < 0.05 ? "0" : fmt::format("{:.1f}", speed_mps); };
  if (most_mps - least_mps < kEqualMps) return words(most_mps) + " m/s";
  return fmt::format("{} to {} m/s", words(least_mps), words(most_mps));
}

std::string decision_words(const Flight& flight) {
  const double end_s = flight.result.flight_time_s;
  if (flight.decisions.empty()) return "the module never decided";
  const LastStretch last = last_stretch(flight.decisions, end_s);
  const double length_s = end_s - last.from_s;
  const std::string when =
      fmt::format("in {} {} s", length_s > 0.99 * end_s ? "the whole" : "its last", rounded(length_s));
  return fmt::format("{} the module reported {} and commanded {}", when, last.statuses,
                     commanded_words(flight.decisions, last.from_s));
}

std::string height_words(const Scenario& scenario, const Flight& flight) {
  const double off_m = -(flight.trajectory.back().p_WB_true - scenario.goal->p_WG()).z();
  const bool over_goal = flight.result.goal_distance_m.value_or(kInfinity) <= scenario.goal->radius_m;
  if (!over_goal || std::abs(off_m) <= scenario.goal->height_tolerance_m) return "";
  return fmt::format(", {:.1f} m too {}", std::abs(off_m), off_m > 0.0 ? "high" : "low");
}

bool requires_goal(const Scenario& scenario) {
  return std::ranges::any_of(scenario.checks,
                             [](const CheckConfig& check) { return std::holds_alternative<ReachedGoalCheck>(check); });
}

std::string first_failure(const std::vector<CheckResult>& checks) {
  const auto failed = std::ranges::find(checks, false, &CheckResult::passed);
  return failed == checks.end() ? "" : failed->name + " " + check_words(*failed);
}

}  // namespace

CoveredWay covered_way(const Scenario& scenario, const Flight& flight) {
  std::vector<GoalConfig> waypoints = scenario.route;
  waypoints.push_back(*scenario.goal);
  const auto place = [](const GoalConfig& goal) { return Eigen::Vector2d(goal.p_WG().head<2>()); };
  size_t next = 0;
  for (const TrajectoryRow& row : flight.trajectory) {
    if (next + 1 < waypoints.size() && waypoints[next].holds(row.p_WB_est)) ++next;
  }
  const auto length_m = [&](Eigen::Vector2d from, size_t first) {
    double sum_m = 0.0;
    for (size_t i = first; i < waypoints.size(); ++i) {
      sum_m += (place(waypoints[i]) - from).norm();
      from = place(waypoints[i]);
    }
    return sum_m;
  };
  const double whole_m = length_m(flight.trajectory.front().p_WB_true.head<2>(), 0);
  return {whole_m - length_m(flight.trajectory.back().p_WB_true.head<2>(), next), whole_m};
}

std::string missed_goal_words(const Scenario& scenario, const Flight& flight) {
  std::string words = decision_words(flight);
  if (!flight.trajectory.empty()) {
    const CoveredWay way = covered_way(scenario, flight);
    words += way.covered_m < -0.5 ? fmt::format("; the flight ended {} m from the goal, {} m at the start",
                                                rounded(way.whole_m - way.covered_m), rounded(way.whole_m))
                                  : fmt::format("; the flight covered {} of {} m",
                                                rounded(std::max(0.0, way.covered_m)), rounded(way.whole_m));
    words += height_words(scenario, flight);
  }
  const ClosestApproach& nearest = flight.last_obstacle;
  if (!std::isfinite(nearest.distance_m)) return words + fmt::format("; no obstacle within {:g} m", kMaxClearanceM);
  return words + fmt::format("; nearest obstacle at the end: {}, {:.1f} m",
                             nearest.what.empty() ? "unnamed" : nearest.what, nearest.distance_m);
}

void explain(const Scenario& scenario, Flight& flight) {
  FlightResult& result = flight.result;
  const bool missed = result.outcome == Outcome::timeout && scenario.goal;
  result.goal_missed_unchecked = missed && !requires_goal(scenario);
  if (!result.cause.empty()) return;
  result.cause = missed ? missed_goal_words(scenario, flight) : first_failure(result.checks);
}

}  // namespace hedgehop::sim
