#include "sim/falsify/box_constraints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace hedgehop::sim {
namespace {

using scenes::BoxConfig;

BoxConfig random_box(std::mt19937& random) {
  const auto draw = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
  BoxConfig box{.north_m = draw(-10, 10), .east_m = draw(-10, 10), .length_m = draw(1, 12), .width_m = draw(1, 12)};
  box.heading_rad = draw(0.0, std::numbers::pi);
  return box;
}

/// Independent oracle: whether a point of a fine grid lies in both boxes.
bool share_a_point(const BoxConfig& a, const BoxConfig& b) {
  constexpr int kSteps = 120;
  const auto corners = a.corners_NE_m();
  for (int i = 0; i <= kSteps; ++i) {
    for (int k = 0; k <= kSteps; ++k) {
      const Eigen::Vector2d p =
          corners[0] + (corners[1] - corners[0]) * i / kSteps + (corners[3] - corners[0]) * k / kSteps;
      if (plan_distance_m(b, p) == 0.0) return true;
    }
  }
  return false;
}

TEST(BoxConstraints, OverlapAgreesWithPointsInBoth) {
  std::mt19937 random(1);
  constexpr double kGridM = 0.2;  // smaller overlaps may contain no grid point
  int both = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const BoxConfig a = random_box(random), b = random_box(random);
    const double overlap = overlap_m(a, b);
    if (std::abs(overlap) < kGridM) continue;
    EXPECT_EQ(overlap > 0.0, share_a_point(a, b));
    both += overlap > 0.0 ? 1 : 0;
  }
  EXPECT_GT(both, 30);
}

/// Counts the points of a fine grid that lie in both boxes.
TEST(BoxConstraints, CommonAreaAgreesWithPointsInBoth) {
  std::mt19937 random(2);
  constexpr int kSteps = 200;
  double max_m2 = 0.0;
  for (int trial = 0; trial < 40; ++trial) {
    const BoxConfig a = random_box(random), b = random_box(random);
    const auto corners = a.corners_NE_m();
    int inside = 0;
    for (int i = 0; i < kSteps; ++i) {
      for (int k = 0; k < kSteps; ++k) {
        const Eigen::Vector2d p = corners[0] + (corners[1] - corners[0]) * (i + 0.5) / kSteps +
                                  (corners[3] - corners[0]) * (k + 0.5) / kSteps;
        inside += plan_distance_m(b, p) == 0.0 ? 1 : 0;
      }
    }
    const double area_m2 = a.length_m * a.width_m, grid_m2 = area_m2 * inside / (kSteps * kSteps);
    EXPECT_NEAR(common_area_m2(a, b), grid_m2, 0.01 * area_m2);  // two rows or columns of the grid
    EXPECT_NEAR(common_area_m2(a, b), common_area_m2(b, a), 1e-9);
    max_m2 = std::max(max_m2, grid_m2);
  }
  EXPECT_GT(max_m2, 10.0);
}

TEST(BoxConstraints, DistanceToARotatedBoxIsMeasuredToItsCornersAndSides) {
  const BoxConfig box{.length_m = 2.0, .width_m = 2.0, .heading_rad = 0.25 * std::numbers::pi};
  EXPECT_NEAR(plan_distance_m(box, {5.0, 0.0}), 5.0 - std::sqrt(2.0), 1e-12);        // to its corner
  EXPECT_NEAR(plan_distance_m(box, {3.0, 3.0}), 3.0 * std::sqrt(2.0) - 1.0, 1e-12);  // to its side
}

/// A field 60 m wide with a goal to the east, and two boxes in a band between start and goal.
FalsifySearch search() {
  FalsifySearch search;
  search.scenario.start = {.north_m = 0.0, .east_m = 0.0};
  search.scenario.goal = GoalConfig{.north_m = 0.0, .east_m = 40.0};
  search.config.boxes = FalsifyBoxes{.count = 2, .north_m = {-30.0, 30.0}, .east_m = {10.0, 30.0}};
  search.config.constraints = {FalsifyConstraint::boxes_inside, FalsifyConstraint::boxes_apart,
                               FalsifyConstraint::way_exists};
  return search;
}

TEST(BoxConstraints, ViolationSumsProtrusionsAndOverlaps) {
  const BoxConfig inside{.north_m = 0.0, .east_m = 20.0, .length_m = 10.0, .width_m = 4.0};
  BoxConfig out = inside;
  out.north_m = 27.0;  // two corners protrude by 2 m
  EXPECT_EQ(violation(search(), {inside}), 0.0);
  EXPECT_NEAR(violation(search(), {inside, out}), 4.0, 1e-9);
  BoxConfig near = inside;
  near.east_m = 23.0;  // boxes 4 m wide: an overlap of 1 m
  EXPECT_NEAR(violation(search(), {inside, near}), 1.0, 1e-9);
}

/// The route runs 20 m east, then 30 m north.
TEST(BoxConstraints, TheRouteMustLeadThroughABox) {
  FalsifySearch along = search();
  along.config.constraints = {FalsifyConstraint::box_on_route};
  along.scenario.route = {GoalConfig{.north_m = 0.0, .east_m = 20.0}};
  along.scenario.goal = GoalConfig{.north_m = 30.0, .east_m = 20.0};
  const auto box = [](double north_m, double east_m) {
    return BoxConfig{.north_m = north_m, .east_m = east_m, .length_m = 4.0, .width_m = 6.0};
  };
  EXPECT_EQ(violation(along, {box(1.0, 10.0)}), 0.0);
  EXPECT_EQ(violation(along, {box(20.0, 22.0)}), 0.0);
  EXPECT_NEAR(violation(along, {box(-5.0, 10.0)}), 3.0, 1e-9);
  EXPECT_NEAR(violation(along, {box(-5.0, 10.0), box(10.0, 24.5)}), 1.5, 1e-9);
  EXPECT_EQ(violation(along, {box(-5.0, 10.0), box(0.0, 10.0)}), 0.0);
}

/// A box around the goal blocks every path to it.
TEST(BoxConstraints, APathToTheGoalMustExist) {
  FalsifySearch at_goal = search();
  at_goal.scenario.goal->east_m = 20.0;
  EXPECT_EQ(violation(at_goal, {{.north_m = 0.0, .east_m = 20.0, .length_m = 8.0, .width_m = 8.0}}), 1.0);
  at_goal.config.constraints = {FalsifyConstraint::boxes_inside};
  EXPECT_EQ(violation(at_goal, {{.north_m = 0.0, .east_m = 20.0, .length_m = 8.0, .width_m = 8.0}}), 0.0);
}

}  // namespace
}  // namespace hedgehop::sim
