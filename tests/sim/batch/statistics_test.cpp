#include "sim/batch/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/libm/random.h"

namespace hedgehop::sim {
namespace {

constexpr double kPrinted4 = 0.00005;  // tables with four decimals

/// Published quantiles of Student's distribution, to three decimals.
TEST(StudentFactor, EqualsTheTables) {
  constexpr double kPrinted = 0.0006;
  EXPECT_NEAR(student_factor(2, 0.95), 12.706, kPrinted);
  EXPECT_NEAR(student_factor(3, 0.95), 4.303, kPrinted);
  EXPECT_NEAR(student_factor(5, 0.95), 2.776, kPrinted);
  EXPECT_NEAR(student_factor(10, 0.95), 2.262, kPrinted);
  EXPECT_NEAR(student_factor(31, 0.99), 2.750, kPrinted);
}

/// [Newcombe1998a] table 1, method 3.
TEST(WilsonInterval, MatchesPublishedTable) {
  struct Row {
    Count count;
    double low, high;
  };
  for (const Row& row : {Row{{81, 263}, 0.2553, 0.3662}, Row{{15, 148}, 0.0624, 0.1605}, Row{{0, 20}, 0.0, 0.1611},
                         Row{{1, 29}, 0.0061, 0.1718}}) {
    const Interval interval = wilson_interval(row.count, 0.95);
    EXPECT_NEAR(interval.low, row.low, kPrinted4);
    EXPECT_NEAR(interval.high, row.high, kPrinted4);
  }
}

/// At the ends of the score interval, the test statistic of the rate equals its critical value.
TEST(WilsonInterval, EndsSolveTheScoreEquation) {
  const double z = normal_quantile(0.95);
  for (int64_t n : {1, 4, 30, 1000}) {
    for (int64_t k = 1; k < n; k += 1 + n / 7) {
      const Interval interval = wilson_interval({k, n}, 0.90);
      const double p = static_cast<double>(k) / static_cast<double>(n);
      for (const double end : {interval.low, interval.high}) {
        EXPECT_NEAR(std::abs(p - end) / std::sqrt(end * (1.0 - end) / static_cast<double>(n)), z, 1e-9);
      }
    }
  }
}

/// [Newcombe1998b] table 2, method 10.
TEST(NewcombeDifference, MatchesPublishedTable) {
  struct Row {
    Count first, second;
    double low, high;
  };
  for (const Row& row : {Row{{56, 70}, {48, 80}, 0.0524, 0.3339}, Row{{9, 10}, {3, 10}, 0.1705, 0.8090},
                         Row{{6, 7}, {2, 7}, 0.0582, 0.8062}, Row{{5, 56}, {0, 29}, -0.0381, 0.1926},
                         Row{{0, 10}, {0, 20}, -0.1611, 0.2775}, Row{{0, 10}, {0, 10}, -0.2775, 0.2775},
                         Row{{10, 10}, {0, 20}, 0.6791, 1.0}, Row{{10, 10}, {0, 10}, 0.6075, 1.0}}) {
    const Interval interval = newcombe_difference(row.first, row.second, 0.95);
    EXPECT_NEAR(interval.low, row.low, kPrinted4) << row.first.successes << "/" << row.first.trials;
    EXPECT_NEAR(interval.high, row.high, kPrinted4) << row.first.successes << "/" << row.first.trials;
  }
}

/// The oracle enumerates all assignments of the successes to the trials.
TEST(FisherLowerTail, EqualsTheEnumerationOfAllAssignments) {
  for (int a = 1; a <= 5; ++a) {
    for (int b = 1; b <= 5; ++b) {
      for (int i = 0; i <= a; ++i) {
        for (int j = 0; j <= b; ++j) {
          int deals = 0, as_few = 0;
          for (unsigned mask = 0; mask < 1u << (a + b); ++mask) {
            if (__builtin_popcount(mask) != i + j) continue;
            ++deals;
            as_few += __builtin_popcount(mask & ((1u << a) - 1u)) <= i ? 1 : 0;
          }
          EXPECT_NEAR(fisher_lower_tail({i, a}, {j, b}), static_cast<double>(as_few) / deals, 1e-12);
        }
      }
    }
  }
}

}  // namespace
}  // namespace hedgehop::sim
