#include "sim/verdict/shortest_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>
#include <vector>

#include "sim/libm/random.h"

namespace hedgehop::sim {
namespace {

using Point = Eigen::Vector2d;

constexpr double kCellM = 0.25;
const Eigen::AlignedBox2d kPlan(Point(-20.0, -20.0), Point(20.0, 20.0));

struct Circle {
  Point center;
  double radius_m;
};
using Circles = std::vector<Circle>;

double clearance_m(const Circles& circles, const Point& p) {
  double min_m = 100.0;
  for (const Circle& c : circles) min_m = std::min(min_m, (p - c.center).norm() - c.radius_m);
  return min_m;
}

/// Brute force: Dijkstra over all pairs of points on the circles, 2 degrees apart, that see each other.
double brute_force_m(const Circles& circles, const Point& start, const GoalCircle& goal) {
  constexpr int kPerTurn = 180;
  std::vector<Point> points{start};
  const auto add_circle = [&](const Point& center, double radius_m) {
    for (int k = 0; k < kPerTurn; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kPerTurn;
      points.push_back(center + radius_m * Point(std::cos(angle), std::sin(angle)));
    }
  };
  for (const Circle& c : circles) add_circle(c.center, c.radius_m);
  const size_t first_of_goal = points.size();
  add_circle(goal.center_NE_m, goal.radius_m);
  const auto sees = [&](const Point& a, const Point& b) {
    for (const Circle& c : circles) {
      const double along = std::clamp((c.center - a).dot(b - a) / std::max((b - a).squaredNorm(), 1e-12), 0.0, 1.0);
      // A chord of 2 degrees lies inside its circle by 1.6e-4 of the radius.
      if ((a + along * (b - a) - c.center).norm() < c.radius_m * (1.0 - 2e-4)) return false;
    }
    return true;
  };
  std::vector<double> length_m(points.size(), std::numeric_limits<double>::infinity());
  std::priority_queue<std::pair<double, size_t>, std::vector<std::pair<double, size_t>>, std::greater<>> open;
  length_m[0] = 0.0;
  open.push({0.0, 0});
  while (!open.empty()) {
    const auto [at_m, node] = open.top();
    open.pop();
    if (at_m > length_m[node]) continue;
    if (node >= first_of_goal) return at_m;
    for (size_t next = 0; next < points.size(); ++next) {
      const double sum_m = at_m + (points[next] - points[node]).norm();
      if (sum_m >= length_m[next] || !sees(points[node], points[next])) continue;
      length_m[next] = sum_m;
      open.push({sum_m, next});
    }
  }
  return std::numeric_limits<double>::infinity();
}

TEST(ShortestPath, IsStraightInFreeSpace) {
  for (const Point& goal : {Point(10.0, 3.0), Point(-7.0, 15.25)}) {
    const auto length_m = shortest_path_m({0.03, 0.0}, {goal, 1.5}, kPlan, kCellM, [](const Point&) { return 5.0; });
    EXPECT_NEAR(length_m.value(), (goal - Point(0.03, 0.0)).norm() - 1.5, 1e-9);
  }
}

TEST(ShortestPath, IsNeverBelowBruteForceAndAtMostTwoPercentAbove) {
  constexpr double kChord = 5e-4;  // brute force cuts its arcs by chords
  const Point start(-15.0, 0.4);
  const GoalCircle goal{{15.0, -1.3}, 1.0};
  int bent = 0;
  for (uint64_t seed = 1; seed <= 40; ++seed) {
    RandomStream random(seed);
    const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
    Circles circles;
    while (circles.size() < 9) {
      const Circle c{Point(between(-12.0, 12.0), between(-6.0, 6.0)), between(0.8, 4.0)};
      // Gaps are closed or wider than a cell, so that neither search depends on rounding.
      bool clear = (c.center - start).norm() > c.radius_m && (c.center - goal.center_NE_m).norm() > c.radius_m + 1.0;
      for (const Circle& other : circles) {
        const double gap_m = (c.center - other.center).norm() - c.radius_m - other.radius_m;
        clear = clear && (gap_m < -0.05 || gap_m > 0.4);
      }
      if (clear) circles.push_back(c);
    }
    const double brute_m = brute_force_m(circles, start, goal);
    const auto length_m =
        shortest_path_m(start, goal, kPlan, kCellM, [&](const Point& p) { return clearance_m(circles, p); });
    ASSERT_TRUE(length_m) << seed;
    EXPECT_GE(*length_m, brute_m * (1.0 - kChord)) << seed;
    EXPECT_LE(*length_m, brute_m * 1.02) << seed;
    bent += brute_m > 1.01 * ((goal.center_NE_m - start).norm() - goal.radius_m) ? 1 : 0;
  }
  EXPECT_GT(bent, 20);  // the worlds have detours
}

TEST(ShortestPath, DoesNotExistThroughAClosedWallOrIntoASolid) {
  const auto walled = [](const Point& p) { return std::abs(p.x() - 5.0) - 0.3; };
  EXPECT_FALSE(shortest_path_m({0.0, 0.0}, {{10.0, 0.0}, 1.0}, kPlan, kCellM, walled));
  EXPECT_FALSE(shortest_path_m({0.0, 0.0}, {{5.0, 0.0}, 0.1}, kPlan, kCellM, walled));
  // A thin wall in a large plan lies between the points of the grid.
  const Eigen::AlignedBox2d large(Point(-500.0, -500.0), Point(500.0, 500.0));
  const auto thin = [](const Point& p) { return std::abs(p.x() - 5.3) - 0.35; };
  EXPECT_FALSE(shortest_path_m({0.0, 0.0}, {{400.0, 0.0}, 1.0}, large, 2.5, thin));
}

TEST(ShortestPath, IsZeroInsideTheGoalCircle) {
  EXPECT_EQ(shortest_path_m({1.0, 0.0}, {{0.0, 0.0}, 2.0}, kPlan, kCellM, [](const Point&) { return 1.0; }), 0.0);
}

}  // namespace
}  // namespace hedgehop::sim
