#include "sim/evidence/anytime_valid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "sim/libm/random.h"

namespace hedgehop::sim {
namespace {

constexpr double kPrinted6 = 0.6e-6;  // references with six decimals

/// Computed by scipy 1.10: betaln and brentq.
TEST(AnytimeInterval, MatchesReferenceValues) {
  struct Row {
    Count events;
    double low, high;
  };
  for (const Row& row :
       {Row{{0, 10}, 0, 0.376987}, Row{{0, 100}, 0, 0.057029}, Row{{0, 1000}, 0, 0.006998},
        Row{{1, 10}, 0.000466, 0.544009}, Row{{1, 100}, 0.000014, 0.084022}, Row{{3, 100}, 0.001879, 0.122949},
        Row{{10, 100}, 0.029061, 0.227510}, Row{{50, 100}, 0.338258, 0.661742}, Row{{90, 100}, 0.772490, 0.970939},
        Row{{5, 1000}, 0.000539, 0.018004}, Row{{300, 1000}, 0.248983, 0.354562}, Row{{10, 10}, 0.623013, 1},
        Row{{0, 0}, 0, 1}}) {
    const Interval interval = anytime_interval(row.events, 0.95);
    EXPECT_NEAR(interval.low, row.low, kPrinted6) << row.events.successes << "/" << row.events.trials;
    EXPECT_NEAR(interval.high, row.high, kPrinted6) << row.events.successes << "/" << row.events.trials;
  }
}

TEST(RateEvidence, MatchesReferenceValues) {
  EXPECT_NEAR(ln_evidence_below({0, 333}, 0.01), 2.993483, kPrinted6);
  EXPECT_NEAR(ln_evidence_below({0, 334}, 0.01), 3.002829, kPrinted6);
  EXPECT_NEAR(ln_evidence_below({1, 664}, 0.01), 3.001925, kPrinted6);
  EXPECT_NEAR(ln_evidence_below({5, 1000}, 0.01), -0.111970, kPrinted6);
  EXPECT_NEAR(ln_evidence_above({10, 100}, 0.05), 0.108164, kPrinted6);
  EXPECT_NEAR(ln_evidence_above({20, 100}, 0.05), 11.771185, kPrinted6);
  EXPECT_NEAR(ln_evidence_above({12, 15}, 0.5), 1.647947, kPrinted6);
  EXPECT_EQ(ln_evidence_above({0, 0}, 0.3), ln_evidence_below({0, 0}, 0.3));
  EXPECT_NEAR(ln_evidence_above({0, 0}, 0.3), 0.0, 1e-15);
}

TEST(AnytimeLimit, MatchesReferenceValuesAndMirrors) {
  EXPECT_NEAR(anytime_upper_limit({0, 100}, 0.95), 0.032959, kPrinted6);
  EXPECT_NEAR(anytime_upper_limit({1, 100}, 0.95), 0.064715, kPrinted6);
  EXPECT_NEAR(anytime_upper_limit({10, 100}, 0.95), 0.218822, kPrinted6);
  EXPECT_NEAR(anytime_lower_limit({90, 100}, 0.95), 1.0 - 0.218822, kPrinted6);
  EXPECT_EQ(anytime_upper_limit({7, 7}, 0.95), 1.0);
  EXPECT_EQ(anytime_lower_limit({0, 7}, 0.95), 0.0);
}

/// A limit is shown if and only if the one-sided upper limit does not exceed it.
TEST(AnytimeLimit, AgreesWithTheTest) {
  for (int64_t n : {20, 66, 131, 500}) {
    for (int64_t k = 0; k <= n / 4; k += 1 + n / 50) {
      for (const double limit : {0.02, 0.05, 0.11, 0.3}) {
        const bool shown = ln_evidence_below({k, n}, limit) >= std::log(20.0);
        EXPECT_EQ(shown, anytime_upper_limit({k, n}, 0.95) <= limit) << k << "/" << n << " " << limit;
      }
    }
  }
}

/// Numbers of trials that show a limit, by number of events.
TEST(RateEvidence, DecidesAfterTheTabulatedNumberOfTrials) {
  const std::vector<int64_t> events{0, 1, 2, 3, 5, 10};
  const auto trials_needed = [](int64_t k, double limit) {
    constexpr int64_t kMaxTrials = 10'000;
    int64_t n = k;
    while (n < kMaxTrials && ln_evidence_below({k, n}, limit) < std::log(20.0)) ++n;
    return n;
  };
  const std::vector<int64_t> at_tenth{32, 64, 88, 109, 147, 228}, at_hundredth{334, 664, 914, 1129, 1511, 2345};
  for (size_t i = 0; i < events.size(); ++i) {
    EXPECT_EQ(trials_needed(events[i], 0.1), at_tenth[i]);
    EXPECT_EQ(trials_needed(events[i], 0.01), at_hundredth[i]);
  }
}

/// Returns the probability that `decides` holds after any of `max_trials` trials, by the exact recursion over (n, k).
double probability_of_ever(double rate, int64_t max_trials, const std::function<bool(Count)>& decides) {
  std::vector<double> undecided{1.0};  // [k]
  double ever = 0.0;
  for (int64_t n = 1; n <= max_trials; ++n) {
    std::vector<double> next(static_cast<size_t>(n) + 1, 0.0);
    for (size_t k = 0; k < undecided.size(); ++k) {
      next[k] += undecided[k] * (1.0 - rate);
      next[k + 1] += undecided[k] * rate;
    }
    for (int64_t k = 0; k <= n; ++k) {
      double& mass = next[static_cast<size_t>(k)];
      if (mass < 1e-15) {
        mass = 0.0;  // the total dropped mass stays below 1e-11
      } else if (decides({k, n})) {
        ever += mass;
        mass = 0.0;
      }
    }
    undecided = std::move(next);
  }
  return ever;
}

/// Errors are most likely if the rate equals the limit; each error rate must stay below 0.05.
TEST(RateEvidence, ErrorRateMatchesTheExactRecursionAndIsBelowThatOfARepeatedWilsonTest) {
  constexpr double kLimit = 0.05, kToleranceOfReference = 2e-4;
  constexpr int64_t kMost = 4000;
  const double decided = std::log(20.0);
  EXPECT_NEAR(probability_of_ever(kLimit, kMost, [&](Count c) { return ln_evidence_below(c, kLimit) >= decided; }),
              0.0474, kToleranceOfReference);
  EXPECT_NEAR(probability_of_ever(kLimit, kMost, [&](Count c) { return ln_evidence_above(c, kLimit) >= decided; }),
              0.0214, kToleranceOfReference);
  // Testing a limit of Wilson's interval after each trial is wrong: its error is nearly four times the nominal one.
  const double z = normal_quantile(0.975);
  const auto wilson_high = [z](Count c) {
    const auto n = static_cast<double>(c.trials);
    const double p = c.rate();
    return (p + z * z / (2 * n) + z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n))) / (1 + z * z / n);
  };
  EXPECT_NEAR(probability_of_ever(kLimit, kMost, [&](Count c) { return wilson_high(c) < kLimit; }), 0.19, 0.01);
}

/// The interval covers the rate at all times together with its confidence; Wilson's interval does not.
TEST(AnytimeInterval, CoversTheRateAtAllTimesUnlikeWilsonsInterval) {
  for (const auto& [rate, misses] : {std::pair{0.5, 0.031}, std::pair{0.01, 0.015}}) {
    const auto outside = [rate = rate](Interval interval) { return rate < interval.low || rate > interval.high; };
    const double anytime = probability_of_ever(rate, 100, [&](Count c) { return outside(anytime_interval(c, 0.95)); });
    EXPECT_NEAR(anytime, misses, 0.0006);
    const double wilson =
        probability_of_ever(rate, 100, [&](Count c) { return c.trials >= 10 && outside(wilson_interval(c, 0.95)); });
    EXPECT_GT(wilson, 0.22);
  }
}

}  // namespace
}  // namespace hedgehop::sim
