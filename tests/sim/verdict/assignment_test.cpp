#include "sim/verdict/assignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>

#include "sim/libm/random.h"

namespace hedgehop::sim {
namespace {

using Eigen::Index;

/// Returns the minimum sum over all permutations of the longer side's indices.
double least_of_permutations(const Eigen::MatrixXd& cost) {
  const Eigen::MatrixXd wide = cost.rows() > cost.cols() ? Eigen::MatrixXd(cost.transpose()) : cost;
  std::vector<Index> columns(static_cast<size_t>(wide.cols()));
  std::iota(columns.begin(), columns.end(), 0);
  double least = std::numeric_limits<double>::infinity();
  do {
    double sum = 0.0;
    for (Index i = 0; i < wide.rows(); ++i) sum += wide(i, columns[static_cast<size_t>(i)]);
    least = std::min(least, sum);
  } while (std::ranges::next_permutation(columns).found);
  return least;
}

TEST(Assignment, CostIsTheMinimumOverAllPermutations) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 400; ++trial) {
    const auto rows = static_cast<Index>(1 + random() % 6), columns = static_cast<Index>(1 + random() % 6);
    Eigen::MatrixXd cost(rows, columns);
    // Integers, also negative ones, produce ties.
    for (double& entry : cost.reshaped()) {
      entry = trial % 2 == 0 ? uniform(random) : std::floor(5.0 * uniform(random)) - 2.0;
    }
    const auto assigned = min_cost_assignment(cost);
    ASSERT_EQ(assigned.size(), static_cast<size_t>(rows));
    std::vector<Index> used;
    double sum = 0.0;
    for (Index i = 0; i < rows; ++i) {
      if (!assigned[static_cast<size_t>(i)]) continue;
      used.push_back(*assigned[static_cast<size_t>(i)]);
      sum += cost(i, used.back());
    }
    EXPECT_EQ(static_cast<Index>(used.size()), std::min(rows, columns));
    std::ranges::sort(used);
    EXPECT_TRUE(std::ranges::adjacent_find(used) == used.end()) << "a column twice";
    EXPECT_NEAR(sum, least_of_permutations(cost), 1e-12);
  }
}

/// Returns the maximum number of pairs within the tolerance with their minimum sum of distances, by exhaustive search.
std::pair<int, double> best_pairs(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b,
                                  double tolerance_m) {
  std::vector<bool> taken(b.size(), false);
  std::pair<int, double> best{0, 0.0};
  const std::function<void(size_t, int, double)> pair_up = [&](size_t i, int pairs, double sum_m) {
    if (pairs > best.first || (pairs == best.first && sum_m < best.second)) best = {pairs, sum_m};
    if (i == a.size()) return;
    pair_up(i + 1, pairs, sum_m);
    for (size_t j = 0; j < b.size(); ++j) {
      const double distance_m = (a[i] - b[j]).norm();
      if (taken[j] || distance_m > tolerance_m) continue;
      taken[j] = true;
      pair_up(i + 1, pairs + 1, sum_m + distance_m);
      taken[j] = false;
    }
  };
  pair_up(0, 0, 0.0);
  return best;
}

TEST(MatchPoints, FindTheMaximumNumberOfPairsWithTheMinimumSumOfDistances) {
  std::mt19937_64 random(6);
  constexpr double kToleranceM = 1.0;
  int refused = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<Eigen::Vector3d> a(random() % 6), b(random() % 6);
    for (auto* points : {&a, &b}) {
      for (Eigen::Vector3d& p : *points) p = 2.5 * Eigen::Vector3d(uniform(random), uniform(random), 0.0);
    }
    const auto partners = match_points(a, b, kToleranceM);
    int pairs = 0;
    double sum_m = 0.0;
    for (size_t i = 0; i < a.size(); ++i) {
      if (!partners[i]) continue;
      const double distance_m = (a[i] - b[static_cast<size_t>(*partners[i])]).norm();
      EXPECT_LE(distance_m, kToleranceM);
      ++pairs;
      sum_m += distance_m;
    }
    const auto [most, least_m] = best_pairs(a, b, kToleranceM);
    EXPECT_EQ(pairs, most);
    EXPECT_NEAR(sum_m, least_m, 1e-12);
    refused += static_cast<int>(std::min(a.size(), b.size())) - most;
  }
  EXPECT_GT(refused, 100);
}

// The near point is nearest to the first one, too; but then the second one would be unmatched.
TEST(MatchPoints, PreferOneMorePairToANearerPartner) {
  const std::vector<Eigen::Vector3d> a{{0, 0, 0}, {1.2, 0, 0}}, b{{0.4, 0, 0}, {-0.9, 0, 0}};
  const auto partners = match_points(a, b, 1.0);
  EXPECT_EQ(partners[0], std::optional<Index>(1));
  EXPECT_EQ(partners[1], std::optional<Index>(0));
}

}  // namespace
}  // namespace hedgehop::sim
