#pragma once

#include <cstdint>

/// Statistical inference from a sample of seeds.
namespace hedgehop::sim {

/// Successes out of a number of trials.
struct Count {
  int64_t successes = 0, trials = 0;

  double rate() const { return static_cast<double>(successes) / static_cast<double>(trials); }
};

struct Interval {
  double low = 0.0, high = 0.0;
};

/// Confidence of the intervals in tables and on pages.
inline constexpr double kTableConfidence = 0.95;

/// Returns the two-sided score interval of a proportion; [0, 1] without trials. @param confidence  in (0, 1).
/// Source: [Wilson1927] p. 212. Its properties: [Newcombe1998a] table 1, method 3.
Interval wilson_interval(Count count, double confidence);

/// Returns the half width of the two-sided interval of a mean, in standard errors, from Student's distribution.
/// @param samples  >= 2. @param confidence  in (0, 1).
/// Source: [AbramowitzStegun1964] eq. (26.7.3) and (26.7.4), solved by bisection.
double student_factor(int64_t samples, double confidence);

/// Returns the two-sided interval of the difference of two proportions, first minus second, from their Wilson
/// intervals.
/// @param confidence  in (0, 1). Both counts must have at least one trial.
/// Source: [Newcombe1998b] p. 876, method 10.
Interval newcombe_difference(Count first, Count second, double confidence);

/// Returns the probability that the first count has at most its number of successes if both counts have the same rate,
/// conditional on the numbers of trials and the total number of successes. Source: [Fisher1934] sec. 21.02.
double fisher_lower_tail(Count first, Count second);

}  // namespace hedgehop::sim
