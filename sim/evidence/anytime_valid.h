#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "sim/batch/statistics.h"

/// What may be looked at after every trial: the error stays within 1 - confidence however often and however long one
/// looks, and whenever one stops. Rates of independent trials, `successes` counting the events.
namespace hedgehop::sim {

/// Two-sided interval of a rate that holds at all times together: the p at which the mixture of likelihood ratios over
/// a Beta(1/2, 1/2) prior stays below 1 / (1 - confidence). [0, 1] without trials. @param confidence  in (0, 1).
/// Source: [HowardEtAl2021] sec. 3.2, the beta-binomial mixture.
Interval anytime_interval(Count events, double confidence);

/// Logarithm of the evidence (an e-process) that the rate is below `limit`, 0 < limit < 1: at rates of `limit` and
/// above it ever reaches ln(1 / (1 - confidence)) with probability 1 - confidence at most. 0 without trials. Source:
/// [HowardEtAl2021] sec. 3.3, discrete mixtures; the 33 rates are ours: odds that fall by 2^(1/4) each from those of
/// the limit, and 0. An even mixture of likelihood ratios, so that no incomplete beta function is needed.
double ln_evidence_below(Count events, double limit);

/// The same that the rate is above `limit`.
double ln_evidence_above(Count events, double limit);

/// One-sided: the least limit that ln_evidence_below() decides, 1 where it decides none.
double anytime_upper_limit(Count events, double confidence);

/// One-sided: the greatest limit that ln_evidence_above() decides, 0 where it decides none.
double anytime_lower_limit(Count events, double confidence);

/// ln of the sum of exp; -infinity of nothing.
class LogSum {
 public:
  void add(double logarithm);
  double value() const;

 private:
  double greatest_ = -std::numeric_limits<double>::infinity(), scaled_sum_ = 0.0;
};

/// Evidence about the mean of numbers in [0, 1], whatever their distribution: the capital of an even mixture of 16
/// constant bets, 2^(-g/2) of the most that may be staked. Valid after every number.
/// Source: [WaudbySmithRamdas2024] sec. 4, the capital process; the fixed bets and their mixture are ours.
class MeanBets {
 public:
  /// @param mean  the hypothesis, in (0, 1).
  explicit MeanBets(double mean) : mean_(mean) {}

  /// @param x  in [0, 1].
  void add(double x);
  /// Logarithm of the evidence that the mean is above the hypothesis, and below it.
  double ln_above() const { return ln_mixture(ln_above_); }
  double ln_below() const { return ln_mixture(ln_below_); }

 private:
  static constexpr size_t kBets = 16;
  using Capitals = std::array<double, kBets>;
  static double ln_mixture(const Capitals& ln_capitals);

  double mean_;
  Capitals ln_above_{}, ln_below_{};
};

/// Two-sided interval of the mean that holds at all times together. @param values  in [0, 1]. @param confidence  in
/// (0, 1). [0, 1] without values.
Interval anytime_mean_interval(const std::vector<double>& values, double confidence);

}  // namespace hedgehop::sim
