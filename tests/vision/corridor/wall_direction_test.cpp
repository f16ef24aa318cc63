#include "vision/corridor/corridor_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/vision/camera/random_lenses.h"

namespace hedgehop::vision::corridor {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;
constexpr double kMaxRad = 50.0 * kDeg;
constexpr double kFinestRad = 0.3 * kDeg;  // the last step of the search, and half as much again

// Points measured by a vehicle whose heading is `turned_rad` to the left of two parallel walls.
std::vector<WallPoint> two_walls(double turned_rad, double left_m, double right_m, uint64_t seed, double noise = 0.0) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<WallPoint> points;
  for (int i = 0; i < 300; ++i) {
    const double along_m = uniform(random, -0.3, 2.5), across_m = i % 2 ? right_m : -left_m;
    const double c = std::cos(turned_rad), s = std::sin(turned_rad);
    WallPoint point;
    point.p_CP_H = {c * along_m - s * across_m, s * along_m + c * across_m, 0.0};
    point.p_CP_H *= 1.0 + noise * normal(random);  // an error of the flow moves a point along its ray
    point.region = i % 2 ? kRight : kLeft;
    points.push_back(point);
  }
  return points;
}

TEST(WallDirection, EqualsThatOfTheWallsForEveryHeading) {
  std::mt19937_64 random(3);
  for (uint64_t seed = 1; seed <= 40; ++seed) {
    const double turned_rad = uniform(random, -45.0 * kDeg, 45.0 * kDeg);
    const auto points = two_walls(turned_rad, uniform(random, 0.4, 3.0), uniform(random, 0.4, 3.0), seed);
    EXPECT_NEAR(wall_direction_rad(points, kMaxRad, 12), turned_rad, kFinestRad) << seed;
  }
}

TEST(WallDirection, IsRobustToNoisyFlowAndATenthOfWrongPoints) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    auto points = two_walls(12.0 * kDeg, 1.1, 1.4, seed, 0.05);
    for (size_t i = 0; i < points.size(); i += 10) points[i].p_CP_H *= 0.3;
    EXPECT_NEAR(wall_direction_rad(points, kMaxRad, 12), 12.0 * kDeg, 2.0 * kDeg) << seed;
  }
}

TEST(WallDirection, IsTheHeadingIfOneSideIsUnknown) {
  auto points = two_walls(20.0 * kDeg, 1.2, 1.2, 1);
  for (WallPoint& point : points) {
    if (point.region == kLeft) point.rejection = RejectionReason::too_slow;
  }
  EXPECT_EQ(wall_direction_rad(points, kMaxRad, 12), 0.0);
}

TEST(WallDirection, MakesTheMediansIndependentOfTheHeading) {
  const auto points = two_walls(25.0 * kDeg, 0.8, 1.7, 5);
  const auto along = rotate_points(points, wall_direction_rad(points, kMaxRad, 12));
  EXPECT_NEAR(side_distance(along, kLeft, 1).distance_m, 0.8, 0.02);
  EXPECT_NEAR(side_distance(along, kRight, 1).distance_m, 1.7, 0.02);
  // Measured across the heading, the left wall appears at half its distance.
  EXPECT_GT(std::abs(side_distance(points, kLeft, 1).distance_m - 0.8), 0.2);
}

}  // namespace
}  // namespace hedgehop::vision::corridor
