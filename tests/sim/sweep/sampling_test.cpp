#include "sim/sweep/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>

namespace hedgehop::sim {
namespace {

/// Counts the points in each box of a grid with 2^levels[d] equal cells along dimension d.
std::map<std::vector<size_t>, int> box_counts(const UnitPoints& points, const std::vector<int>& levels) {
  std::map<std::vector<size_t>, int> counts;
  for (const std::vector<double>& point : points) {
    std::vector<size_t> box;
    for (size_t d = 0; d < levels.size(); ++d) {
      box.push_back(static_cast<size_t>(point[d] * static_cast<double>(1 << levels[d])));
    }
    ++counts[box];
  }
  return counts;
}

/// Whether 2^m points are a (t, m, s)-net in base 2: every elementary box of volume 2^(t - m) holds 2^t of them.
bool is_net(const UnitPoints& points, int t, int m, size_t dimensions) {
  bool holds = true;
  std::vector<int> levels;
  const std::function<void(int)> divide = [&](int left) {
    if (levels.size() + 1 == dimensions) {
      levels.push_back(left);
      const auto counts = box_counts(points, levels);
      holds = holds && counts.size() == size_t{1} << (m - t);
      for (const auto& [box, count] : counts) holds = holds && count == 1 << t;
      levels.pop_back();
      return;
    }
    for (int level = 0; level <= left; ++level) {
      levels.push_back(level);
      divide(left - level);
      levels.pop_back();
    }
  };
  divide(m - t);
  return holds;
}

/// Sobol's t is the sum of the polynomials' degrees, each less one: 0, 0, 1, 3, 5 for 1 to 5 dimensions.
TEST(Sobol, EverySegmentOfAPowerOfTwoIsANet) {
  constexpr int kQuality[] = {0, 0, 1, 3, 5};
  for (size_t dimensions = 1; dimensions <= 5; ++dimensions) {
    const int t = kQuality[dimensions - 1];
    for (int m = t; m <= t + 4; ++m) {
      for (uint32_t segment = 0; segment < 3; ++segment) {
        UnitPoints points;
        for (uint32_t i = 0; i < 1u << m; ++i) points.push_back(sobol_point((segment << m) + i, dimensions));
        EXPECT_TRUE(is_net(points, t, m, dimensions)) << dimensions << " dimensions, 2^" << m << ", " << segment;
      }
    }
  }
}

/// Sobol's property A, which the numbers of Joe and Kuo satisfy by design: 2^s points, one in each of the 2^s orthants.
TEST(Sobol, OrthantsOfTheCubeHoldOnePointEach) {
  constexpr size_t kFast = 12;
  for (size_t dimensions = 1; dimensions <= kFast; ++dimensions) {
    UnitPoints points;
    for (uint32_t i = 0; i < 1u << dimensions; ++i) points.push_back(sobol_point(i, dimensions));
    EXPECT_EQ(box_counts(points, std::vector<int>(dimensions, 1)).size(), size_t{1} << dimensions) << dimensions;
  }
}

/// The first bits of 2^20 points span all orthants of 20 dimensions if the matrix of these bits has full rank.
TEST(Sobol, FirstBitsOfAllDimensionsAreIndependent) {
  std::vector<uint32_t> rows;
  for (uint32_t k = 0; k < kSobolDimensions; ++k) {
    uint32_t row = 0;
    const std::vector<double> point = sobol_point(1u << k, kSobolDimensions);
    for (size_t d = 0; d < kSobolDimensions; ++d) row |= (point[d] >= 0.5 ? 1u : 0u) << d;
    rows.push_back(row);
  }
  size_t rank = 0;
  for (uint32_t bit = 0; bit < kSobolDimensions; ++bit) {
    const auto pivot = std::find_if(rows.begin() + static_cast<std::ptrdiff_t>(rank), rows.end(),
                                    [&](uint32_t row) { return (row >> bit & 1u) != 0; });
    if (pivot == rows.end()) continue;
    std::iter_swap(rows.begin() + static_cast<std::ptrdiff_t>(rank), pivot);
    for (size_t i = 0; i < rows.size(); ++i) {
      if (i != rank && (rows[i] >> bit & 1u) != 0) rows[i] ^= rows[rank];
    }
    ++rank;
  }
  EXPECT_EQ(rank, kSobolDimensions);
}

TEST(Sobol, RejectsDimensionsWithoutDirectionNumbers) {
  EXPECT_THROW(sobol_point(1, 0), std::invalid_argument);
  EXPECT_THROW(sobol_point(1, kSobolDimensions + 1), std::invalid_argument);
}

TEST(LatinHypercube, EveryStratumOfEveryCoordinateHoldsOnePoint) {
  for (const size_t points : {1, 2, 7, 64}) {
    for (uint64_t seed = 1; seed <= 5; ++seed) {
      const UnitPoints drawn = latin_hypercube(points, 3, seed);
      for (size_t d = 0; d < 3; ++d) {
        std::set<size_t> strata;
        for (const auto& point : drawn) strata.insert(static_cast<size_t>(point[d] * static_cast<double>(points)));
        EXPECT_EQ(strata.size(), points);
      }
    }
  }
  EXPECT_EQ(latin_hypercube(9, 2, 4), latin_hypercube(9, 2, 4));
  EXPECT_NE(latin_hypercube(9, 2, 4), latin_hypercube(9, 2, 5));
}

TEST(RandomPoints, FillTheCubeEvenly) {
  const UnitPoints drawn = random_points(8192, 2, 3);
  const auto counts = box_counts(drawn, {2, 2});
  EXPECT_EQ(counts.size(), 16u);
  for (const auto& [box, count] : counts) {
    EXPECT_NEAR(count, 512, 5 * 22);  // five standard deviations of a binomial count
  }
}

}  // namespace
}  // namespace hedgehop::sim
