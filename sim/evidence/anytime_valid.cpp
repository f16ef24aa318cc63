#include "sim/evidence/anytime_valid.h"

#include <cmath>

#include "sim/fields/quantities.h"

namespace hedgehop::sim {
namespace {

constexpr int kHalvings = 200;  // more than a double resolves

/// Returns count * ln(rate); 0 if the count is 0.
double log_power(int64_t count, double log_rate) { return count == 0 ? 0.0 : static_cast<double>(count) * log_rate; }

/// Returns ln of the likelihood ratio of the Beta(1/2, 1/2) mixture to the rate p.
double ln_mixture(Count events, double p) {
  constexpr double kA = 0.5, kB = 0.5;
  const auto n = static_cast<double>(events.trials), k = static_cast<double>(events.successes);
  return std::lgamma(kA + k) + std::lgamma(kB + n - k) - std::lgamma(kA + kB + n) - std::lgamma(kA) - std::lgamma(kB) +
         std::lgamma(kA + kB) - log_power(events.successes, std::log(p)) -
         log_power(events.trials - events.successes, std::log1p(-p));
}

/// Returns the boundary between `from` and `to` at which `holds` changes its value.
template <class Predicate>
double boundary(double from, double to, Predicate holds) {
  const bool at_from = holds(from);
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (from + to);
    (holds(middle) == at_from ? from : to) = middle;
  }
  return 0.5 * (from + to);
}

Count complement(Count events) { return {events.trials - events.successes, events.trials}; }

}  // namespace

void LogSum::add(double logarithm) {
  if (logarithm == -kInfinity) return;
  if (logarithm > max_) {
    scaled_sum_ = scaled_sum_ * std::exp(max_ - logarithm) + 1.0;
    max_ = logarithm;
  } else {
    scaled_sum_ += std::exp(logarithm - max_);
  }
}

double LogSum::value() const { return scaled_sum_ > 0.0 ? max_ + std::log(scaled_sum_) : -kInfinity; }

Interval anytime_interval(Count events, double confidence) {
  if (events.trials == 0) return {0.0, 1.0};
  const double decided = -std::log1p(-confidence), rate = events.rate();
  const auto inside = [&](double p) { return ln_mixture(events, p) < decided; };
  // The mixture falls on (0, k/n) and rises on (k/n, 1).
  return {events.successes == 0 ? 0.0 : boundary(0.0, rate, inside),
          events.successes == events.trials ? 1.0 : boundary(rate, 1.0, inside)};
}

double ln_evidence_below(Count events, double limit) {
  constexpr int kRates = 32;
  const double odds = limit / (1.0 - limit);
  const int64_t others = events.trials - events.successes;
  LogSum sum;
  for (int j = 1; j <= kRates; ++j) {
    const double alternative = odds * std::exp2(-0.25 * j), rate = alternative / (1.0 + alternative);
    sum.add(log_power(events.successes, std::log(rate / limit)) +
            log_power(others, std::log1p(-rate) - std::log1p(-limit)));
  }
  if (events.successes == 0) sum.add(log_power(others, -std::log1p(-limit)));  // the rate 0
  return sum.value() - std::log(kRates + 1.0);
}

double ln_evidence_above(Count events, double limit) { return ln_evidence_below(complement(events), 1.0 - limit); }

double anytime_upper_limit(Count events, double confidence) {
  if (events.successes == events.trials) return 1.0;
  const double decided = -std::log1p(-confidence);
  const auto undecided = [&](double limit) { return ln_evidence_below(events, limit) < decided; };
  // The evidence rises with the limit.
  return boundary(events.rate(), 1.0, [&](double limit) { return limit == events.rate() || undecided(limit); });
}

double anytime_lower_limit(Count events, double confidence) {
  return 1.0 - anytime_upper_limit(complement(events), confidence);
}

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
  // The evidence for a mean above m falls with m, that for a mean below m rises. Bisection finds each end.
  constexpr int kMeanHalvings = 40;  // resolution 1e-12
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
