#include "sim/pages/decimate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace hedgehop::sim {
namespace {

using ::testing::ElementsAre;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Decimate, KeepsEveryRowOfAShortTable) {
  const std::vector<std::vector<double>> series = {{3.0, 1.0, 2.0}};
  EXPECT_THAT(decimate(series, 3), ElementsAre(0, 1, 2));
  EXPECT_TRUE(decimate({}, 10).empty());
}

TEST(Decimate, KeepsAllExtremesOfAllSeries) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise;
  for (const size_t rows : {101u, 1000u, 18001u}) {
    std::vector<std::vector<double>> series(3, std::vector<double>(rows));
    for (auto& values : series) std::ranges::generate(values, [&] { return noise(random); });
    const std::vector<size_t> kept = decimate(series, 100);
    EXPECT_LE(kept.size(), 100u);
    EXPECT_TRUE(std::ranges::is_sorted(kept, std::ranges::less_equal{}));
    EXPECT_EQ(kept.front(), 0u);
    EXPECT_EQ(kept.back(), rows - 1);
    for (const auto& values : series) {
      const auto holds = [&](auto place) {
        return std::ranges::binary_search(kept, static_cast<size_t>(place - values.begin()));
      };
      EXPECT_TRUE(holds(std::ranges::min_element(values)));
      EXPECT_TRUE(holds(std::ranges::max_element(values)));
    }
  }
}

TEST(Simplified, AllPointsAreWithinTheToleranceAndTheEndsRemain) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> step(0.0, 0.1);
  constexpr double kToleranceM = 0.05, kFloatM = 1e-4;
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<Eigen::Vector2d> line = {{1000.0, -2000.0}};
    Eigen::Vector2d velocity(0.0, 0.0);
    while (line.size() < 500) {
      velocity += 0.1 * Eigen::Vector2d(step(random), step(random));
      line.push_back(line.back() + velocity);
    }
    const std::vector<Eigen::Vector2d> kept = simplified(line, kToleranceM, line.size());
    EXPECT_LT(kept.size(), line.size());
    EXPECT_LT((kept.front() - line.front()).norm() + (kept.back() - line.back()).norm(), kFloatM);
    for (const Eigen::Vector2d& p : line) {
      double nearest_m = 1e9;
      for (size_t i = 1; i < kept.size(); ++i) {
        const Eigen::Vector2d way = kept[i] - kept[i - 1];
        const double along = std::clamp((p - kept[i - 1]).dot(way) / way.squaredNorm(), 0.0, 1.0);
        nearest_m = std::min(nearest_m, (p - kept[i - 1] - along * way).norm());
      }
      EXPECT_LE(nearest_m, kToleranceM + kFloatM);
    }
    EXPECT_LE(simplified(line, kToleranceM, 10).size(), 10u);
  }
}

TEST(Decimate, KeepsAShortGap) {
  std::vector<std::vector<double>> series(1, std::vector<double>(10000, 1.0));
  series[0][4321] = kNaN;
  EXPECT_TRUE(std::ranges::binary_search(decimate(series, 50), size_t{4321}));
}

}  // namespace
}  // namespace hedgehop::sim
