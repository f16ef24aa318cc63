#pragma once

#include <optional>
#include <span>
#include <vector>

#include "scenes/additions.h"
#include "sim/falsify/falsify_file.h"
#include "sim/falsify/weakest_check.h"

/// Scores of the UAV testing competition, edition of 2025. A test is a set of boxes; a suite is a set of tests.
namespace hedgehop::sim {

/// One run of a test.
struct CompetitionRun {
  double min_distance_m = 0.0;  ///< between hull and obstacles; <= 0: a collision
  double time_s = 0.0;          ///< of the flight, > 0
};

/// A run is unsafe if it comes closer to an obstacle than this, m.
inline constexpr double kSafeDistanceM = 1.5;

/// Returns the points of a run: 5 below 0.25 m, 2 below 1 m, 1 below 1.5 m, else 0.
/// Source: [KhatiriEtAl2025] eq. (1). Differs: the competition measures, in the horizontal plane, from a path that is
/// 0.25 m wide; here the distance is that of the hull.
int run_points(double min_distance_m);

/// Returns the score of a test: ten times the mean points of its runs, divided by the square of the number of boxes and
/// by the mean time in minutes. @param runs  not empty. @param boxes  number of boxes, >= 1.
/// Source: [KhatiriEtAl2025] eq. (2). Differs: the time is that of the simulated flight, which starts in the air; the
/// competition's also contains take-off and landing.
double test_score(std::span<const CompetitionRun> runs, size_t boxes);

/// Returns the area that the boxes of two tests share, divided by the area of both together: 0 to 1.
/// @param a, b  boxes of one test, which do not overlap each other.
/// Source: [KhatiriEtAl2025] eq. (4).
double similarity(const std::vector<scenes::BoxConfig>& a, const std::vector<scenes::BoxConfig>& b);

/// Returns one minus the mean similarity of all pairs of tests; nullopt with fewer than two tests.
/// Source: [KhatiriEtAl2025] eq. (5).
std::optional<double> diversity_score(const std::vector<std::vector<scenes::BoxConfig>>& tests);

/// Returns the objective that a search minimizes. With `score: robustness` that is the weakest check. With `score:
/// sbft` it is the distance beyond 1.5 m of a safe flight, or the negative score of the single run of an unsafe one.
/// Because points change in steps, 0.1 per meter below 1.5 m is added, so that the search also moves within a step.
/// @return nullopt if the flight was not flown.
std::optional<WeakestCheck> objective(const FalsifySearch& search, const FlightRecord& record);

/// Returns a flight as a run of a test. The flight must have a result.
CompetitionRun competition_run(const FlightRecord& record);

}  // namespace hedgehop::sim
