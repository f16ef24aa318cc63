#include "vision/stereo/flight_corridor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "tests/vision/stereo/random_disparity.h"

namespace hedgehop::vision::stereo {
namespace {

// [Andert2007] fig. 11, counted there.
TEST(CorridorTargets, ThePapersLatticeHas21And64Candidates) {
  const NearbyLattice lattice;
  const std::vector<cv::Point> fine = fine_targets({100, 80}, lattice), coarse = coarse_targets({100, 80}, lattice);
  EXPECT_EQ(fine.size(), 21u);
  EXPECT_EQ(coarse.size(), 64u);
  std::set<std::pair<int, int>> all;
  for (const auto& points : {fine, coarse}) {
    for (const cv::Point& p : points) all.insert({p.x, p.y});
  }
  EXPECT_EQ(all.size(), 85u);
  EXPECT_TRUE(all.contains({100, 80}));
}

TEST(CorridorTargets, QuadtreeBlocksAreFarMaximalAndDisjoint) {
  std::mt19937_64 random(9);
  for (int trial = 0; trial < 60; ++trial) {
    const cv::Mat d = random_disparity(random, {96, 64}, trial);
    DepthPyramid pyramid;
    pyramid.build(d, 5);
    const double far_disparity16 = 60.5;
    const auto is_far = [&](int level, int row, int col) {
      const cv::Mat block = d(cv::Rect(col << level, row << level, 1 << level, 1 << level));
      double least = 0.0, most = 0.0;
      cv::minMaxLoc(block, &least, &most);
      return most >= 0.0 && most < far_disparity16;
    };
    std::set<std::pair<int, int>> expected;  // of every level, far blocks whose parents are not
    for (int level = 1; level <= 4; ++level) {
      for (int row = 0; row < 64 >> level; ++row) {
        for (int col = 0; col < 96 >> level; ++col) {
          if (!is_far(level, row, col) || (level < 4 && is_far(level + 1, row / 2, col / 2))) continue;
          bool ancestor_far = false;
          for (int up = level + 1; up <= 4; ++up) ancestor_far |= is_far(up, row >> (up - level), col >> (up - level));
          if (!ancestor_far) expected.insert({(col << level) + (1 << level) / 2, (row << level) + (1 << level) / 2});
        }
      }
    }
    std::set<std::pair<int, int>> found;
    for (const cv::Point& p : quadtree_targets(pyramid, far_disparity16, 4, 1)) found.insert({p.x, p.y});
    EXPECT_EQ(found, expected) << trial;
  }
}

TEST(CorridorTargets, CostIsTheWeightedChangeOfDirection) {
  const TargetCost cost{0.0, 2.0, 3.0};
  const Eigen::Vector3d forward = Eigen::Vector3d::UnitZ();
  const double kPi = std::numbers::pi;
  EXPECT_NEAR(target_cost(cost, {10.0, 0.0, 10.0}, forward), 2.0 * kPi / 4, 1e-12);
  EXPECT_NEAR(target_cost(cost, {0.0, -10.0, 10.0}, forward), 3.0 * kPi / 4, 1e-12);
  EXPECT_NEAR(target_cost(cost, {3.0, 1.0, 7.0}, Eigen::Vector3d(6.0, 2.0, 14.0)), 0.0, 1e-12);
  EXPECT_NEAR(target_cost({-0.5, 0.0, 0.0}, {0.0, 0.0, 8.0}, forward), -4.0, 1e-12);
}

}  // namespace
}  // namespace hedgehop::vision::stereo
