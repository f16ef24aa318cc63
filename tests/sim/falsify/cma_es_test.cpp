#include "sim/falsify/cma_es.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace hedgehop::sim {
namespace {

/// The table of the specification, computed by another program.
TEST(CmaEs, DefaultParametersForTenUnknownsMatchTheTable) {
  const CmaEsParameters p(10);
  constexpr double kPrinted = 5e-7;
  EXPECT_EQ(p.population, 10u);
  ASSERT_EQ(p.weights.size(), 5);
  const double weights[] = {.456273, .270753, .162231, .085234, .025510};
  for (Eigen::Index i = 0; i < 5; ++i) EXPECT_NEAR(p.weights[i], weights[i], kPrinted);
  EXPECT_NEAR(p.mu_eff, 3.167299, kPrinted);
  EXPECT_NEAR(p.c_sigma, .284429, kPrinted);
  EXPECT_NEAR(p.d_sigma, 1.284429, kPrinted);
  EXPECT_NEAR(p.c_c, .294990, kPrinted);
  EXPECT_NEAR(p.c_1, .015284, kPrinted);
  EXPECT_NEAR(p.c_mu, .020154, kPrinted);
}

using Function = std::function<double(const Eigen::VectorXd&)>;

/// Evaluations until the cost is below 1e-9, from (1 .. 1) with step 0.5 in ten dimensions.
double evaluations(const Function& function, uint64_t seed) {
  CmaEs search(Eigen::VectorXd::Ones(10), 0.5, seed);
  for (int count = 0; count < 100'000;) {
    std::vector<CostedPoint> generation;
    for (size_t i = 0; i < search.population(); ++i) {
      Eigen::VectorXd x = search.draw();
      const double cost = function(x);
      ++count;
      if (cost < 1e-9) return count;
      generation.push_back({std::move(x), cost});
    }
    search.adapt(std::move(generation));
  }
  return INFINITY;
}

double median_evaluations(const Function& function) {
  std::vector<double> counts;
  for (uint64_t seed = 1; seed <= 11; ++seed) counts.push_back(evaluations(function, seed));
  std::ranges::sort(counts);
  return counts[5];
}

/// A second implementation took 1410 to 1580, and 5460 to 6510.
TEST(CmaEs, NumberOfEvaluationsMatchesAnIndependentImplementation) {
  EXPECT_NEAR(median_evaluations([](const Eigen::VectorXd& x) { return x.squaredNorm(); }), 1495.0, 0.15 * 1495.0);
  const auto ellipsoid = [](const Eigen::VectorXd& x) {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(x.size() - 1);
      sum += std::pow(1e6, share) * x[i] * x[i];
    }
    return sum;
  };
  EXPECT_NEAR(median_evaluations(ellipsoid), 5985.0, 0.15 * 5985.0);
}

TEST(CmaEs, OnlyEqualSeedsGiveEqualPoints) {
  const Eigen::VectorXd start = Eigen::VectorXd::Constant(3, 0.5);
  EXPECT_EQ(CmaEs(start, 0.2, 7).draw(), CmaEs(start, 0.2, 7).draw());
  EXPECT_NE(CmaEs(start, 0.2, 7).draw(), CmaEs(start, 0.2, 8).draw());
}

}  // namespace
}  // namespace hedgehop::sim
