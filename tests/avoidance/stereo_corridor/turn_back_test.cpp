#include "avoidance/stereo_corridor/turn_back.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hedgehop::avoidance::stereo_corridor {
namespace {

/// A camera at a place in the plan, looking along a heading, both as north and east.
Eigen::Vector3d seen(const Eigen::Vector2d& goal_NE, const Eigen::Vector2d& at_NE, double heading_rad) {
  const Eigen::Vector2d to_goal = goal_NE - at_NE;
  const Eigen::Vector2d ahead(std::cos(heading_rad), std::sin(heading_rad)), right(-ahead.y(), ahead.x());
  return {to_goal.dot(right), 2.0, to_goal.dot(ahead)};
}

TEST(TurnBack, AGoalAheadOrComingNearerIsFlownTo) {
  TurnBack turn_back;
  for (double north_m = 0.0; north_m < 50.0; north_m += 0.5) {
    EXPECT_FALSE(turn_back.update(seen({50.0, 10.0}, {north_m, 0.0}, 0.0))) << north_m;
  }
  // Backwards, as round an obstacle: nearer, though behind; and farther, though ahead.
  TurnBack round;
  for (double s = 0.0; s < 40.0; s += 0.5) EXPECT_FALSE(round.update(seen({0.0, 0.0}, {50.0 - s, 0.0}, 0.0)));
  for (double s = 0.0; s < 40.0; s += 0.5) EXPECT_FALSE(round.update(seen({0.0, 0.0}, {-10.0 - s, 0.0}, 0.0)));
}

TEST(TurnBack, APassedGoalIsTurnedToUntilItLiesAhead) {
  for (const double side : {-1.0, 1.0}) {
    TurnBack turn_back;
    const Eigen::Vector2d goal(20.0, 30.0 * side);
    double north_m = 0.0;
    while (north_m < 40.0 && !turn_back.update(seen(goal, {north_m, 0.0}, 0.0))) north_m += 0.1;
    EXPECT_GT(north_m, 21.0);
    EXPECT_GT(std::hypot(north_m - 20.0, 30.0), 30.3);
    EXPECT_LT(std::hypot(north_m - 20.0, 30.0), 30.4);
    double heading_rad = 0.0;
    while (turn_back.update(seen(goal, {north_m, 0.0}, heading_rad))) heading_rad += side * 0.01;
    EXPECT_NEAR(heading_rad, side * (M_PI / 2.0 + std::atan2(north_m - 20.0, 30.0) - std::atan(0.2)), 0.02);
  }
}

// A street that leads away from the goal: the turns come 1, 2, 4, 8 ... m behind it.
TEST(TurnBack, TurnsThatDoNotHelpBecomeRarer) {
  TurnBack turn_back;
  std::vector<double> turns_m;
  for (double north_m = 0.0; north_m < 40.0; north_m += 0.01) {
    if (!turn_back.update(seen({0.0, 0.0}, {north_m, 0.0}, 0.0))) continue;
    turns_m.push_back(north_m);
    turn_back.update(seen({0.0, 0.0}, {north_m, 0.0}, M_PI));
  }
  ASSERT_EQ(turns_m.size(), 6U);
  for (size_t k = 0; k < turns_m.size(); ++k) EXPECT_NEAR(turns_m[k], std::exp2(k), 0.02) << k;
}

TEST(TurnBack, OneThatHelpedIsFollowedByThePatienceOfTheFirst) {
  TurnBack turn_back;
  for (const double aside_m : {9.0, 6.0, 0.0}) {
    EXPECT_FALSE(turn_back.update({0.0, 0.0, 20.0}));
    double passed_m = -10.0;
    while (!turn_back.update({aside_m, 0.0, -passed_m})) passed_m += 0.1;
    // A meter behind and 0.3 m farther than at the nearest.
    EXPECT_NEAR(passed_m, std::max(1.0, std::sqrt(0.09 + 0.6 * aside_m)), 0.11) << aside_m;
  }
}

}  // namespace
}  // namespace hedgehop::avoidance::stereo_corridor
