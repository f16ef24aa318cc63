#include "sim/evidence/betting.h"

#include <cmath>

#include "sim/evidence/anytime_valid.h"

namespace hedgehop::sim {

void MeanBets::add(double x) {
  for (size_t g = 0; g < kBets; ++g) {
    const double stake = std::exp2(-0.5 * static_cast<double>(g + 1));
    ln_above_[g] += std::log1p(stake * (x / mean_ - 1.0));
    ln_below_[g] += std::log1p(stake * ((1.0 - x) / (1.0 - mean_) - 1.0));
  }
}

double MeanBets::ln_mixture(const Capitals& ln_capitals) {
  LogSum sum;
  for (const double ln_capital : ln_capitals) sum.add(ln_capital);
  return sum.value() - std::log(static_cast<double>(kBets));
}

Interval anytime_mean_interval(const std::vector<double>& values, double confidence) {
  const double decided = std::log(2.0 / (1.0 - confidence));
  const auto bets = [&](double mean) {
    MeanBets all(mean);
    for (const double x : values) all.add(x);
    return all;
  };
  // Evidence for a mean above m falls in m, that for one below rises: each end by bisection.
  constexpr int kMeanHalvings = 40;  // a thousand million millionth
  Interval interval{0.0, 1.0};
  double low = 0.0, high = 1.0;
  for (int i = 0; i < kMeanHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (bets(middle).ln_above() >= decided ? low : high) = middle;
  }
  interval.low = low;
  high = 1.0;
  for (int i = 0; i < kMeanHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (bets(middle).ln_below() >= decided ? high : low) = middle;
  }
  interval.high = high;
  return interval;
}

}  // namespace hedgehop::sim
