#include "avoidance/landmark_map/map_route.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "sim/libm/random.h"

namespace hedgehop::avoidance::landmark_map {
namespace {

using Eigen::Vector2d;

double length(const Vector2d& from, const std::vector<Vector2d>& way) {
  double sum = 0.0;
  Vector2d at = from;
  for (const Vector2d& next : way) {
    sum += (next - at).norm();
    at = next;
  }
  return sum;
}

/// Minimum distance between sampled points of a path and of the edges of a hull.
double sampled_distance(const Vector2d& from, const std::vector<Vector2d>& way, const PlanHull& hull) {
  constexpr int kSamples = 200;
  double least = INFINITY;
  Vector2d at = from;
  for (const Vector2d& next : way) {
    for (int i = 0; i <= kSamples; ++i) {
      const Vector2d p = at + (next - at) * i / kSamples;
      for (size_t k = 0; k < hull.size(); ++k) {
        for (int j = 0; j <= kSamples; ++j) {
          const Vector2d q = hull[k] + (hull[(k + 1) % hull.size()] - hull[k]) * j / kSamples;
          least = std::min(least, (p - q).norm());
        }
      }
    }
    at = next;
  }
  return least;
}

TEST(MapRoute, PointsWithinTheLinkDistanceShareAHull) {
  const std::vector<Vector2d> points = {{0, 0}, {20, 0}, {4, 0}, {4, 4}, {0, 4}, {2, 2}, {20, 3}};
  const auto hulls = plan_hulls(points, 5.0);
  ASSERT_EQ(hulls.size(), 2U);
  EXPECT_EQ(hulls[0].size(), 4U);
  EXPECT_EQ(hulls[1].size(), 2U);
}

TEST(MapRoute, FreePathIsStraight) {
  const std::vector<PlanHull> hulls = {{{10, 10}, {12, 10}}};
  const auto way = path_around(hulls, {0, 0}, {30, 0}, 4.0);
  ASSERT_TRUE(way);
  EXPECT_EQ(*way, (std::vector<Vector2d>{{30, 0}}));
}

// The shortest path around a point is two tangents and an arc; eight turning points make it slightly longer.
TEST(MapRoute, PathAroundAPointIsNearlyTwoTangentsAndAnArc) {
  const double clearance_m = 5.0, half_m = 30.0;
  const auto way = path_around(std::vector<PlanHull>{{{0, 0.1}}}, {-half_m, 0}, {half_m, 0}, clearance_m);
  ASSERT_TRUE(way);
  const double tangent_m = std::sqrt(half_m * half_m - clearance_m * clearance_m);
  const double shortest_m = 2.0 * (tangent_m + clearance_m * std::asin(clearance_m / half_m));
  EXPECT_GE(length({-half_m, 0}, *way), shortest_m - 0.1);
  EXPECT_LE(length({-half_m, 0}, *way), 1.02 * shortest_m);
}

TEST(MapRoute, KeepsTheClearanceFromRandomHulls) {
  std::mt19937_64 random(41);
  int found = 0, turned = 0;
  for (int scene = 0; scene < 30; ++scene) {
    std::vector<Vector2d> points;
    for (int i = 0; i < 8; ++i) points.emplace_back(uniform(random, -20, 20), uniform(random, -20, 20));
    const auto hulls = plan_hulls(points, 6.0);
    const Vector2d from(-40, uniform(random, -10, 10)), to(40, uniform(random, -10, 10));
    const auto way = path_around(hulls, from, to, 3.0);
    if (!way) continue;
    ++found;
    turned += way->size() > 1;
    EXPECT_EQ(way->back(), to);
    for (const PlanHull& hull : hulls) EXPECT_GE(sampled_distance(from, *way, hull), 3.0 - 1e-6) << scene;
  }
  EXPECT_EQ(found, 30);
  EXPECT_GT(turned, 15);
}

TEST(MapRoute, LeavesAPointWithinTheClearanceWithoutComingNearer) {
  const std::vector<PlanHull> hulls = {{{0, 0}}};
  const auto way = path_around(hulls, {-2, 0}, {30, 0}, 5.0);
  ASSERT_TRUE(way);
  EXPECT_GE(sampled_distance({-2, 0}, *way, hulls[0]), 2.0 - 1e-6);
}

/// Signed distance to the lines of the edges, by definition; negative outside.
double depth(const PlanHull& hull, const Vector2d& p) {
  double least_m = INFINITY;
  for (size_t k = 0; k < hull.size(); ++k) {
    const Vector2d edge = hull[(k + 1) % hull.size()] - hull[k];
    least_m = std::min(least_m, (edge.x() * (p - hull[k]).y() - edge.y() * (p - hull[k]).x()) / edge.norm());
  }
  return least_m;
}

// The vehicle is inside the outline of a tower and of a false landmark in front of it; the tower is straight ahead.
TEST(MapRoute, PathFromInsideAHullDoesNotCrossTheHull) {
  const PlanHull hull = {{-12, 0}, {0, -10}, {20, -10}, {20, 10}, {0, 10}};
  const Vector2d from(-10, 0), to(60, 0);
  const auto way = path_around(std::vector<PlanHull>{hull}, from, to, 4.0);
  ASSERT_TRUE(way);
  ASSERT_GT(way->size(), 1U);
  EXPECT_GE(std::abs(way->front().y()), 13.9);
}

TEST(MapRoute, PathsFromAndToInsideRandomHullsDoNotGetDeeper) {
  std::mt19937_64 random(43);
  int begin = 0, end = 0;
  for (int scene = 0; scene < 200; ++scene) {
    std::vector<Vector2d> points;
    for (int i = 0; i < 7; ++i) points.emplace_back(uniform(random, -15, 15), uniform(random, -15, 15));
    const std::vector<PlanHull> hulls = plan_hulls(points, 100.0);
    Vector2d from(uniform(random, -15, 15), uniform(random, -15, 15)), to(60, 0);
    if (depth(hulls[0], from) <= 0.0) continue;
    if (scene % 2 == 1) std::swap(from, to);
    (scene % 2 == 1 ? end : begin)++;
    const auto way = path_around(hulls, from, to, 3.0);
    ASSERT_TRUE(way) << scene;
    const double most_m = std::max(depth(hulls[0], from), depth(hulls[0], to));
    Vector2d at = from;
    for (const Vector2d& next : *way) {
      for (int i = 0; i <= 200; ++i) EXPECT_LE(depth(hulls[0], at + (next - at) * i / 200), most_m + 1e-6) << scene;
      at = next;
    }
  }
  EXPECT_GT(begin, 20);
  EXPECT_GT(end, 20);
}

}  // namespace
}  // namespace hedgehop::avoidance::landmark_map
