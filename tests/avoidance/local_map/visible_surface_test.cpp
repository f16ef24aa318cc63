#include "avoidance/local_map/moving_obstacles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <random>

namespace hedgehop::avoidance::local_map {
namespace {

std::vector<Eigen::Vector2d> scattered(std::mt19937& random, int count) {
  std::uniform_real_distribution<double> spread(-3.0, 3.0);
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < count; ++i) points.emplace_back(spread(random), spread(random));
  return points;
}

// Compared with OpenCV's hull.
TEST(VisibleSurface, IsTheConvexHullOfItsPoints) {
  std::mt19937 random(1);
  for (int world = 0; world < 50; ++world) {
    const std::vector<Eigen::Vector2d> points = scattered(random, 1 + world % 12);
    VisibleSurface surface;
    surface.see(0.0, points);
    std::vector<cv::Point2f> all, hull;
    for (const Eigen::Vector2d& p : points) all.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
    cv::convexHull(all, hull);
    const std::vector<Eigen::Vector2d> found = surface.hull_W();
    ASSERT_EQ(found.size(), hull.size());
    for (const cv::Point2f& corner : hull) {
      EXPECT_TRUE(std::ranges::any_of(
          found, [&](const Eigen::Vector2d& p) { return (p - Eigen::Vector2d(corner.x, corner.y)).norm() < 1e-5; }));
    }
  }
}

// Compared with the nearest of many points of its edges, and with OpenCV's point-in-polygon test.
TEST(VisibleSurface, DistanceIsThatOfItsNearestPoint) {
  std::mt19937 random(2);
  for (int world = 0; world < 50; ++world) {
    VisibleSurface surface;
    surface.see(0.0, scattered(random, 1 + world % 9));
    const std::vector<Eigen::Vector2d> hull = surface.hull_W();
    std::vector<cv::Point2f> corners;
    for (const Eigen::Vector2d& p : hull) corners.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
    for (const Eigen::Vector2d& p : scattered(random, 20)) {
      double least_m = std::numeric_limits<double>::infinity();
      for (size_t i = 0; i < hull.size(); ++i) {
        for (double share = 0.0; share <= 1.0; share += 0.001) {
          least_m = std::min(least_m, (p - hull[i] - share * (hull[(i + 1) % hull.size()] - hull[i])).norm());
        }
      }
      const cv::Point2f at(static_cast<float>(p.x()), static_cast<float>(p.y()));
      if (hull.size() > 2 && cv::pointPolygonTest(corners, at, false) > 0.0) least_m = 0.0;
      EXPECT_NEAR(away_m(hull, p), least_m, 0.01);
    }
  }
}

TEST(VisibleSurface, MovesAndKeepsPointsOutOfViewForALimitedTime) {
  VisibleSurface surface;
  const std::vector<Eigen::Vector2d> near = {{1.0, 0.0}}, far = {{4.0, 0.0}};
  surface.see(0.0, near);
  surface.move({0.0, 2.0});
  surface.see(1.0, far);
  EXPECT_NEAR(away_m(surface.hull_W(), {0.0, 2.0}), 1.0, 1e-9);
  surface.see(1.9, far);
  EXPECT_NEAR(away_m(surface.hull_W(), {0.0, 2.0}), 1.0, 1e-9);
  surface.see(2.1, far);
  EXPECT_NEAR(away_m(surface.hull_W(), {0.0, 0.0}), 4.0, 1e-9);
}

}  // namespace
}  // namespace hedgehop::avoidance::local_map
