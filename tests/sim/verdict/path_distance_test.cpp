#include "sim/verdict/path_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <random>
#include <string>

#include "sim/libm/random.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {
namespace {

using Path = std::vector<TimedPoint>;

Path random_path(std::mt19937_64& generator, size_t points) {
  Path path;
  for (size_t i = 0; i < points; ++i) {
    path.push_back(
        {0.5 * static_cast<double>(i), {4.0 * uniform(generator), 4.0 * uniform(generator), 4.0 * uniform(generator)}});
  }
  return path;
}

double distance(const TimedPoint& p, const TimedPoint& q) { return (p.p_WB - q.p_WB).norm(); }

/// Calls `visit` for every monotonic walk along both paths from first to last points, as (i, j) pairs.
void for_each_walk(size_t n, size_t m, std::vector<std::pair<size_t, size_t>>& walk,
                   const std::function<void()>& visit) {
  const auto [i, j] = walk.back();
  if (i + 1 == n && j + 1 == m) return visit();
  for (const auto& [di, dj] : {std::pair<size_t, size_t>{1, 0}, {0, 1}, {1, 1}}) {
    if (i + di >= n || j + dj >= m) continue;
    walk.emplace_back(i + di, j + dj);
    for_each_walk(n, m, walk, visit);
    walk.pop_back();
  }
}

TEST(PathDistance, EqualsTheMinimumOverAllWalks) {
  std::mt19937_64 generator(11);
  for (int trial = 0; trial < 20; ++trial) {
    const Path a = random_path(generator, 1 + generator() % 6), b = random_path(generator, 1 + generator() % 6);
    double leash = 1e9, warped = 1e9;
    std::vector<std::pair<size_t, size_t>> walk{{0, 0}};
    for_each_walk(a.size(), b.size(), walk, [&] {
      double longest = 0.0, sum = 2.0 * distance(a[0], b[0]);
      for (size_t k = 0; k < walk.size(); ++k) {
        const double d = distance(a[walk[k].first], b[walk[k].second]);
        longest = std::max(longest, d);
        if (k == 0) continue;
        sum += d * static_cast<double>(walk[k].first - walk[k - 1].first + walk[k].second - walk[k - 1].second);
      }
      leash = std::min(leash, longest);
      warped = std::min(warped, sum / static_cast<double>(a.size() + b.size()));
    });
    EXPECT_NEAR(discrete_frechet_m(a, b), leash, 1e-12);
    EXPECT_NEAR(mean_warped_distance_m(a, b), warped, 1e-12);
  }
}

TEST(PathDistance, ParallelLinesHaveTheirOffsetAsDistance) {
  Path a, b;
  for (int i = 0; i <= 50; ++i) {
    a.push_back({0.1 * i, {0.2 * i, 0.0, -10.0}});
    b.push_back({0.1 * i, {0.2 * i, 3.0, -14.0}});
  }
  EXPECT_NEAR(max_deviation_m(a, b), 5.0, 1e-12);
  EXPECT_NEAR(discrete_frechet_m(a, b), 5.0, 1e-12);
  EXPECT_NEAR(mean_warped_distance_m(a, b), 5.0, 1e-12);
}

/// The same line at half the speed: delayed by up to half its length, but always on it.
TEST(PathDistance, DelayCountsForTheBandOnly) {
  Path fast, slow;
  for (int i = 0; i <= 100; ++i) fast.push_back({0.1 * i, {0.2 * i, 0.0, -10.0}});
  for (int i = 0; i <= 200; ++i) slow.push_back({0.1 * i, {0.1 * i, 0.0, -10.0}});
  EXPECT_NEAR(max_deviation_m(slow, fast), 10.0, 1e-9);
  EXPECT_NEAR(discrete_frechet_m(slow, fast), 0.1, 1e-9);
  EXPECT_LT(mean_warped_distance_m(slow, fast), 0.05);
}

TEST(PathDistance, BandIsLinearBetweenTheReferencesPoints) {
  const Path reference{{0.0, {0.0, 0.0, 0.0}}, {10.0, {20.0, 0.0, 0.0}}};
  EXPECT_NEAR(max_deviation_m({{0.0, {0.0, 0.0, 0.0}}, {7.0, {14.0, 1.0, 0.0}}, {10.0, {20.0, 0.0, 0.0}}}, reference),
              1.0, 1e-12);
  EXPECT_NEAR(max_deviation_m({{0.0, {0.0, 0.0, 0.0}}, {10.0, {20.0, 0.0, 0.0}}, {12.0, {23.0, 0.0, 0.0}}}, reference),
              3.0, 1e-12);
}

TEST(PathDistance, BandComparesAnEarlyEndWithTheRestOfTheReference) {
  Path reference, flown;
  for (int i = 0; i <= 100; ++i) reference.push_back({0.1 * i, {0.2 * i, 0.0, -10.0}});
  flown.assign(reference.begin(), reference.begin() + 61);
  EXPECT_NEAR(max_deviation_m(flown, reference), 8.0, 1e-12);
  EXPECT_NEAR(max_deviation_m(reference, flown), 8.0, 1e-12);
}

TEST(ReferencePath, OfPointsInOneMillisecondTheLastIsReadBack) {
  ReferencePath reference{.reason = "good", .version = "0", .seed = 1, .step_s = 0.1, .points = {}};
  reference.points = {{0.0, {0.0, 0.0, -1.0}}, {0.3, {1.0, 0.0, -1.0}}, {0.3004, {2.0, 0.0, -1.0}}};
  const TemporaryFolder folder;
  const std::string file = folder.path() / "one_millisecond.csv";
  std::ofstream(file) << reference_text(reference);
  const Path read = read_reference_path(file).points;
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[1].t_s, 0.3);
  EXPECT_EQ(read[1].p_WB.x(), 2.0);
}

TEST(Thinned, KeepsFirstLastAndTheStep) {
  Path path;
  for (int i = 0; i <= 1003; ++i) path.push_back({0.01 * i, {0.01 * i, 0.0, 0.0}});
  const Path kept = thinned(path, 0.1);
  ASSERT_EQ(kept.size(), 102u);
  EXPECT_EQ(kept.back().t_s, path.back().t_s);
  for (size_t i = 0; i + 1 < kept.size(); ++i) EXPECT_NEAR(kept[i].t_s, 0.1 * static_cast<double>(i), 1e-9);
}

}  // namespace
}  // namespace hedgehop::sim
