#pragma once

#include <cstdint>

/// What a sample of seeds shows about all of them.
namespace hedgehop::sim {

/// Successes out of a number of trials.
struct Count {
  int64_t successes = 0, trials = 0;

  double rate() const { return static_cast<double>(successes) / static_cast<double>(trials); }
};

struct Interval {
  double low = 0.0, high = 0.0;
};

/// Of the intervals in tables and on pages.
inline constexpr double kTableConfidence = 0.95;

/// Two-sided score interval of a proportion; [0, 1] without trials. @param confidence  in (0, 1).
/// Source: [Wilson1927] p. 212. Its properties: [Newcombe1998a] table 1, method 3.
Interval wilson_interval(Count count, double confidence);

/// Two-sided interval of the difference of two proportions, first less second, from their Wilson intervals.
/// @param confidence  in (0, 1). Both counts need a trial. Source: [Newcombe1998b] p. 876, method 10.
Interval newcombe_difference(Count first, Count second, double confidence);

/// Probability that chance alone, with one and the same rate behind both counts, gives the first as few successes as it
/// has or fewer, the numbers of trials and of all successes being what they are. Source: [Fisher1934] sec. 21.02.
double fisher_lower_tail(Count first, Count second);

}  // namespace hedgehop::sim
