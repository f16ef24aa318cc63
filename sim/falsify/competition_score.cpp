#include "sim/falsify/competition_score.h"

#include <algorithm>
#include <cmath>

#include "sim/falsify/box_constraints.h"

namespace hedgehop::sim {
namespace {

constexpr double kGuidePerM = 0.1;  // less than one point over 1.5 m: 0.28 with three boxes in four minutes

double area_m2(const std::vector<scenes::BoxConfig>& boxes) {
  double sum_m2 = 0.0;
  for (const scenes::BoxConfig& box : boxes) sum_m2 += box.length_m * box.width_m;
  return sum_m2;
}

}  // namespace

int run_points(double min_distance_m) {
  if (min_distance_m < 0.25) return 5;
  if (min_distance_m < 1.0) return 2;
  return min_distance_m < kSafeDistanceM ? 1 : 0;
}

double test_score(std::span<const CompetitionRun> runs, size_t boxes) {
  double points = 0.0, time_s = 0.0;
  for (const CompetitionRun& run : runs) {
    points += run_points(run.min_distance_m);
    time_s += run.time_s;
  }
  const auto count = static_cast<double>(runs.size());
  const double mean_points = points / count, mean_min = time_s / count / 60.0;
  return mean_points * 10.0 / (static_cast<double>(boxes * boxes) * mean_min);
}

double similarity(const std::vector<scenes::BoxConfig>& a, const std::vector<scenes::BoxConfig>& b) {
  double common_m2 = 0.0;
  for (const scenes::BoxConfig& one : a) {
    for (const scenes::BoxConfig& other : b) common_m2 += common_area_m2(one, other);
  }
  return common_m2 / (area_m2(a) + area_m2(b) - common_m2);
}

std::optional<double> diversity_score(const std::vector<std::vector<scenes::BoxConfig>>& tests) {
  if (tests.size() < 2) return {};
  double sum = 0.0;
  size_t pairs = 0;
  for (size_t i = 0; i < tests.size(); ++i) {
    for (size_t k = 0; k < i; ++k, ++pairs) sum += similarity(tests[i], tests[k]);
  }
  return 1.0 - sum / static_cast<double>(pairs);
}

CompetitionRun competition_run(const FlightRecord& record) {
  const FlightResult& flight = record.result->flight;
  return {std::min(flight.closest_obstacle.distance_m, kMaxClearanceM), flight.flight_time_s};
}

std::optional<WeakestCheck> objective(const FalsifySearch& search, const FlightRecord& record) {
  if (search.config.score == FalsifyScore::robustness) return weakest_check(record, search.config.robustness);
  if (verdict_of(record) == Verdict::not_flown || !record.result) return {};
  const CompetitionRun run = competition_run(record);
  const double margin_m = run.min_distance_m - kSafeDistanceM;
  if (margin_m >= 0.0) return WeakestCheck{"distance", margin_m};
  const auto boxes = static_cast<size_t>(search.config.boxes->count);
  return WeakestCheck{"distance", kGuidePerM * margin_m - test_score({&run, 1}, boxes)};
}

}  // namespace hedgehop::sim
