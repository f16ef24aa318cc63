#include "sim/verdict/corridor_truth.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <variant>

#include "sim/libm/random.h"

namespace hedgehop::sim {
namespace {

using Eigen::Vector2d;

/// Returns the distance from p along a direction to the line through a and b, m.
double distance_to_line_m(const Vector2d& p, const Vector2d& direction, const Vector2d& a, const Vector2d& b) {
  const Vector2d along = b - a, normal(-along.y(), along.x());
  return normal.dot(a - p) / normal.dot(direction);
}

/// Returns half the absolute difference between each finite signal and the truth.
std::vector<double> centering_deviations(const scenes::worlds::CorridorPlan& plan, const Flight& flight) {
  const auto signal = std::ranges::find(flight.signals, "centering_error", &NamedUnit::name);
  std::vector<double> deviations;
  if (signal == flight.signals.end()) return deviations;
  const auto column = static_cast<size_t>(signal - flight.signals.begin());
  for (const DecisionRow& decision : flight.decisions) {
    const double error = decision.signals[column];
    constexpr double kSameTickS = 1e-6;
    const auto row = std::ranges::lower_bound(flight.trajectory, decision.t_s - kSameTickS, {}, &TrajectoryRow::t_s);
    if (std::isnan(error) || row == flight.trajectory.end()) continue;
    const CorridorPlace place = corridor_place(plan, row->p_WB_true.head<2>());
    const double true_error = (place.right_m - place.left_m) / (place.right_m + place.left_m);
    deviations.push_back(0.5 * std::abs(error - true_error));
  }
  return deviations;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

CorridorPlace corridor_place(const scenes::worlds::CorridorPlan& plan, const Vector2d& p_NE) {
  CorridorPlace place;
  double nearest_m = std::numeric_limits<double>::infinity(), passed_m = 0.0;
  for (size_t k = 0; k + 1 < plan.middles_NE.size(); ++k) {
    const Vector2d section = plan.middles_NE[k + 1] - plan.middles_NE[k], along = section.normalized();
    const Vector2d right(-along.y(), along.x());
    const double along_m = std::clamp(along.dot(p_NE - plan.middles_NE[k]), 0.0, section.norm());
    const double off_m = (plan.middles_NE[k] + along_m * along - p_NE).norm();
    if (off_m < nearest_m) {
      nearest_m = off_m;
      place = {distance_to_line_m(p_NE, -right, plan.lefts_NE[k], plan.lefts_NE[k + 1]),
               distance_to_line_m(p_NE, right, plan.rights_NE[k], plan.rights_NE[k + 1]), passed_m + along_m};
    }
    passed_m += section.norm();
  }
  return place;
}

std::vector<MetricValue> corridor_metrics(const Scenario& scenario, const Flight& flight) {
  const auto* corridor = std::get_if<scenes::worlds::CorridorConfig>(&scenario.scene);
  if (!corridor || flight.trajectory.empty()) return {};
  const scenes::worlds::CorridorPlan plan =
      scenes::worlds::plan_corridor(*corridor, stream_seed(scenario.world(), kSceneStream));
  std::vector<double> offs_m;
  double settled_m = std::numeric_limits<double>::quiet_NaN();
  constexpr double kSettledM = 15.0;
  const double begin_m = corridor_place(plan, flight.trajectory.front().p_WB_true.head<2>()).along_m;
  for (const TrajectoryRow& row : flight.trajectory) {
    const CorridorPlace place = corridor_place(plan, row.p_WB_true.head<2>());
    offs_m.push_back(0.5 * std::abs(place.right_m - place.left_m));
    if (place.along_m >= begin_m + kSettledM) settled_m = std::fmax(settled_m, offs_m.back());
  }
  std::vector<MetricValue> metrics = {{"off_middle_mean_m", mean(offs_m), "m"},
                                      {"off_middle_max_m", *std::ranges::max_element(offs_m), "m"},
                                      {"off_middle_after_15m_m", settled_m, "m"}};
  std::vector<double> deviations = centering_deviations(plan, flight);
  if (!deviations.empty()) {
    std::ranges::sort(deviations);
    metrics.push_back({"centering_error_mean", mean(deviations), ""});
    metrics.push_back({"centering_error_median", deviations[deviations.size() / 2], ""});
    metrics.push_back({"centering_error_max", deviations.back(), ""});
    const double decisions = static_cast<double>(flight.decisions.size());
    metrics.push_back({"centering_known_share", static_cast<double>(deviations.size()) / decisions, ""});
  }
  return metrics;
}

}  // namespace hedgehop::sim
