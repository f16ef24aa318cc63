#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "sim/batch/statistics.h"

namespace hedgehop::sim {

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
