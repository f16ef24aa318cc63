#include "sim/verdict/shortest_path.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hedgehop::sim {
namespace {

constexpr double kCellM = 0.25;
const Eigen::AlignedBox2d kPlan(Eigen::Vector2d(-20.0, -20.0), Eigen::Vector2d(20.0, 20.0));

TEST(ShortestPath, IsStraightInFreeSpace) {
  const auto free = [](const Eigen::Vector2d&) { return true; };
  for (const Eigen::Vector2d& goal : {Eigen::Vector2d(10.0, 3.0), Eigen::Vector2d(-7.0, 15.25)}) {
    EXPECT_NEAR(*shortest_path_m({0.0, 0.0}, goal, kPlan, kCellM, free), goal.norm(), 1e-9);
  }
}

/// Around the end of a wall: two sides of a triangle.
TEST(ShortestPath, TurnsAtTheWallsEnd) {
  const auto free = [](const Eigen::Vector2d& p) { return std::abs(p.x() - 5.0) > 0.3 || p.y() > 4.0; };
  const double length_m = *shortest_path_m({0.0, 0.0}, {10.0, 0.0}, kPlan, kCellM, free);
  const double shortest_m = 2.0 * std::hypot(4.7, 4.0) + 0.6;
  EXPECT_GE(length_m, shortest_m - 1e-9);
  EXPECT_LE(length_m, shortest_m + 2.0 * kCellM);
}

TEST(ShortestPath, DoesNotExistThroughAClosedWallOrIntoASolid) {
  const auto walled = [](const Eigen::Vector2d& p) { return std::abs(p.x() - 5.0) > 0.3; };
  EXPECT_FALSE(shortest_path_m({0.0, 0.0}, {10.0, 0.0}, kPlan, kCellM, walled));
  EXPECT_FALSE(shortest_path_m({0.0, 0.0}, {5.0, 0.0}, kPlan, kCellM, walled));
}

}  // namespace
}  // namespace hedgehop::sim
