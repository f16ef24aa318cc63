#include "sim/sweep/sensitivity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "sim/sweep/design.h"

namespace hedgehop::sim {
namespace {

SweepParameter range(const std::string& path, double from, double to) {
  SweepParameter parameter{.path = path, .values = {}};
  parameter.from = from;
  parameter.to = to;
  return parameter;
}

/// The points of a Sobol design with indices, as numbers.
std::vector<std::vector<double>> points_of(const SweepConfig& sweep) {
  const DesignPoints design(sweep);
  std::vector<std::vector<double>> points;
  for (size_t i = 0; i < design.size(); ++i) {
    points.emplace_back();
    for (const std::string& text : design.values(i)) points.back().push_back(std::strtod(text.c_str(), nullptr));
  }
  return points;
}

/// sin x1 + a sin^2 x2 + b x3^4 sin x1 on [-pi, pi]^3. Its variances have a closed form: [Saltelli2010] sec. 5.
TEST(SobolIndices, OfTheIshigamiFunctionEqualTheClosedForm) {
  constexpr double a = 7.0, b = 0.1, pi = std::numbers::pi;
  SweepConfig sweep{.design = SobolDesign{.points = 4096, .indices = true}};
  for (const char* name : {"x1", "x2", "x3"}) sweep.parameters.push_back(range(name, -pi, pi));
  std::vector<double> figures;
  for (const auto& x : points_of(sweep)) {
    figures.push_back(std::sin(x[0]) + a * std::pow(std::sin(x[1]), 2) + b * std::pow(x[2], 4) * std::sin(x[0]));
  }
  ASSERT_EQ(figures.size(), 4096u * 5u);
  const double v1 = 0.5 * std::pow(1.0 + b * std::pow(pi, 4) / 5.0, 2), v2 = a * a / 8.0;
  const double v13 = b * b * std::pow(pi, 8) * (1.0 / 18.0 - 1.0 / 50.0), v = v1 + v2 + v13;
  const double first[] = {v1 / v, v2 / v, 0.0}, total[] = {(v1 + v13) / v, v2 / v, v13 / v};
  constexpr double kIntegration = 0.01;
  const std::vector<SobolIndex> indices = sobol_indices(figures, 3);
  ASSERT_EQ(indices.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(indices[i].first, first[i], kIntegration) << i;
    EXPECT_NEAR(indices[i].total, total[i], kIntegration) << i;
    EXPECT_LE(indices[i].first_interval.low, first[i] + kIntegration) << i;
    EXPECT_GE(indices[i].first_interval.high, first[i] - kIntegration) << i;
    EXPECT_LT(indices[i].total_interval.high - indices[i].total_interval.low, 0.1) << i;
  }
}

/// x + y + 2 x y with x, y of -1 and 1: variances 1, 1 and 4.
TEST(GridIndices, OfTwoFactorsWithAnInteractionAreExact) {
  const std::vector<double> figures = {-1 - 1 + 2, -1 + 1 - 2, 1 - 1 - 2, 1 + 1 + 2};
  const std::vector<SobolIndex> indices = grid_indices(figures, {2, 2});
  ASSERT_EQ(indices.size(), 2u);
  for (const SobolIndex& index : indices) {
    EXPECT_NEAR(index.first, 1.0 / 6.0, 1e-15);
    EXPECT_NEAR(index.total, 5.0 / 6.0, 1e-15);
  }
}

/// The value of the first parameter alone: the others have no share.
TEST(GridIndices, OfAGridWithUnequalSidesFollowTheOrderOfTheDesign) {
  std::vector<double> figures;
  for (const double x : {1.0, 2.0, 5.0}) {
    for (int rest = 0; rest < 2 * 4; ++rest) figures.push_back(x);
  }
  const std::vector<SobolIndex> indices = grid_indices(figures, {3, 2, 4});
  EXPECT_NEAR(indices[0].first, 1.0, 1e-12);
  for (const size_t other : {1, 2}) EXPECT_NEAR(indices[other].total, 0.0, 1e-12);
  EXPECT_TRUE(grid_indices(std::vector<double>(4, 3.3), {2, 2}).empty());
}

TEST(DesignPoints, HaveCleanDecimals) {
  SweepConfig sweep;
  sweep.parameters = {range("a", 0.1, 0.7), range("b", 0.01, 10.0)};
  sweep.parameters[0].count = 7;
  sweep.parameters[1].count = 4;
  sweep.parameters[1].scale = SweepParameter::Scale::log;
  const DesignPoints design(sweep);
  ASSERT_EQ(design.size(), 28u);
  const char* const linear[] = {"0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7"};
  const char* const log[] = {"0.01", "0.1", "1", "10"};
  for (size_t i = 0; i < 28; ++i) {
    EXPECT_EQ(design.values(i), (std::vector<std::string>{linear[i / 4], log[i % 4]}));
  }
}

/// Only the values of the probed points exist: a million points need a few megabytes.
TEST(DesignPoints, CountTooManyPointsWithoutMakingThem) {
  SweepConfig sweep;
  for (const char* path : {"a", "b", "c"}) {
    sweep.parameters.push_back(range(path, 0.0, 1.0));
    sweep.parameters.back().count = 1'000'000;
  }
  EXPECT_EQ(count_points(sweep), kMaxSweepPoints + 1);
  sweep.parameters.pop_back();
  sweep.parameters[0].count = sweep.parameters[1].count = 1000;
  EXPECT_EQ(count_points(sweep), kMaxSweepPoints);
  EXPECT_EQ(DesignPoints(sweep).values(999'999), (std::vector<std::string>{"1", "1"}));
}

}  // namespace
}  // namespace hedgehop::sim
