#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "sim/batch/statistics.h"

/// Anytime-valid statistics, which may be evaluated after every trial. The error probability stays within
/// 1 - confidence for any number of evaluations and any stopping time. Rates are those of independent trials;
/// `successes` counts the events.
namespace hedgehop::sim {

/// Returns the two-sided interval of a rate, valid at all times together. It contains each p for which the mixture of
/// likelihood ratios over a Beta(1/2, 1/2) prior stays below 1 / (1 - confidence). [0, 1] without trials.
/// @param confidence  in (0, 1).
/// Source: [HowardEtAl2021] sec. 3.2, the beta-binomial mixture.
Interval anytime_interval(Count events, double confidence);

/// Returns the logarithm of the evidence (an e-process) that the rate is below `limit`, 0 < limit < 1. If the rate is
/// `limit` or above, the evidence ever reaches ln(1 / (1 - confidence)) with probability at most 1 - confidence. 0
/// without trials.
/// Source: [HowardEtAl2021] sec. 3.3, discrete mixtures. The 33 rates are ours: 32 whose odds fall by a factor of
/// 2^(1/4) each from those of the limit, and 0. The uniform mixture needs no incomplete beta function.
double ln_evidence_below(Count events, double limit);

/// Returns the logarithm of the evidence that the rate is above `limit`, like ln_evidence_below().
double ln_evidence_above(Count events, double limit);

/// Returns the one-sided upper limit: the minimum limit that ln_evidence_below() decides; 1 if it decides for no limit.
double anytime_upper_limit(Count events, double confidence);

/// Returns the one-sided lower limit: the maximum limit that ln_evidence_above() decides; 0 if it decides for no limit.
double anytime_lower_limit(Count events, double confidence);

/// Logarithm of a sum of exponentials; -infinity for an empty sum.
class LogSum {
 public:
  void add(double logarithm);
  double value() const;

 private:
  double max_ = -std::numeric_limits<double>::infinity(), scaled_sum_ = 0.0;
};

/// Evidence about the mean of numbers in [0, 1] of any distribution: the capital of a uniform mixture of 16 constant
/// bets. Bet g stakes the share 2^(-g/2) of the maximum. Valid after every number.
/// Source: [WaudbySmithRamdas2024] sec. 4, the capital process; the fixed bets and their mixture are ours.
class MeanBets {
 public:
  /// @param mean  the hypothesis, in (0, 1).
  explicit MeanBets(double mean) : mean_(mean) {}

  /// @param x  in [0, 1].
  void add(double x);
  /// Logarithm of the evidence that the mean is above (below) the hypothesis.
  double ln_above() const { return ln_mixture(ln_above_); }
  double ln_below() const { return ln_mixture(ln_below_); }

 private:
  static constexpr size_t kBets = 16;
  using Capitals = std::array<double, kBets>;
  static double ln_mixture(const Capitals& ln_capitals);

  double mean_;
  Capitals ln_above_{}, ln_below_{};
};

/// Returns the two-sided interval of the mean, valid at all times together; [0, 1] without values.
/// @param values  in [0, 1]. @param confidence  in (0, 1).
Interval anytime_mean_interval(const std::vector<double>& values, double confidence);

}  // namespace hedgehop::sim
