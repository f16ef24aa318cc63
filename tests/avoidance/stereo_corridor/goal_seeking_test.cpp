#include "avoidance/stereo_corridor/goal_seeking.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hedgehop::avoidance::stereo_corridor {
namespace {

/// A camera at a horizontal position with a heading, both as north and east.
Eigen::Vector3d seen(const Eigen::Vector2d& goal_NE, const Eigen::Vector2d& at_NE, double heading_rad) {
  const Eigen::Vector2d to_goal = goal_NE - at_NE;
  const Eigen::Vector2d ahead(std::cos(heading_rad), std::sin(heading_rad)), right(-ahead.y(), ahead.x());
  return {to_goal.dot(right), 2.0, to_goal.dot(ahead)};
}

/// Returns the turn decision at a position and a heading, both as north and east.
bool turns(TurnBack& turn_back, const Eigen::Vector2d& goal_NE, const Eigen::Vector2d& at_NE, double heading_rad) {
  return turn_back.update(seen(goal_NE, at_NE, heading_rad), {at_NE.x(), at_NE.y(), -2.0});
}

TEST(TurnBack, DoesNotTurnToAGoalThatIsAheadOrComesNearer) {
  TurnBack turn_back;
  for (double north_m = 0.0; north_m < 50.0; north_m += 0.5) {
    EXPECT_FALSE(turns(turn_back, {50.0, 10.0}, {north_m, 0.0}, 0.0)) << north_m;
  }
  // Backwards, as around an obstacle: nearer but behind; and farther but ahead.
  TurnBack round;
  for (double s = 0.0; s < 40.0; s += 0.5) EXPECT_FALSE(turns(round, {0.0, 0.0}, {50.0 - s, 0.0}, 0.0));
  for (double s = 0.0; s < 40.0; s += 0.5) EXPECT_FALSE(turns(round, {0.0, 0.0}, {-10.0 - s, 0.0}, 0.0));
}

TEST(TurnBack, TurnsToAPassedGoalUntilItIsAhead) {
  for (const double side : {-1.0, 1.0}) {
    TurnBack turn_back;
    const Eigen::Vector2d goal(20.0, 30.0 * side);
    double north_m = 0.0;
    while (north_m < 40.0 && !turns(turn_back, goal, {north_m, 0.0}, 0.0)) north_m += 0.1;
    EXPECT_GT(north_m, 21.0);
    EXPECT_GT(std::hypot(north_m - 20.0, 30.0), 30.3);
    EXPECT_LT(std::hypot(north_m - 20.0, 30.0), 30.4);
    double heading_rad = 0.0;
    while (std::abs(heading_rad) < 2.0 * M_PI && turns(turn_back, goal, {north_m, 0.0}, heading_rad)) {
      heading_rad += side * 0.01;
    }
    EXPECT_NEAR(heading_rad, side * (M_PI / 2.0 + std::atan2(north_m - 20.0, 30.0) - std::atan(0.2)), 0.02);
  }
}

// A street that leads away from the goal. The first turn is a meter behind the goal. Further turns are at least 3 m
// apart, each at twice the distance.
TEST(TurnBack, TurnsWithoutSuccessBecomeRarer) {
  TurnBack turn_back;
  std::vector<double> turns_m;
  for (double north_m = 0.0; north_m < 40.0; north_m += 0.01) {
    if (!turns(turn_back, {0.0, 0.0}, {north_m, 0.0}, 0.0)) continue;
    turns_m.push_back(north_m);
    turns(turn_back, {0.0, 0.0}, {north_m, 0.0}, M_PI);
  }
  const std::vector<double> expected_m{1.0, 4.0, 8.0, 16.0, 32.0};
  ASSERT_EQ(turns_m.size(), expected_m.size());
  for (size_t k = 0; k < turns_m.size(); ++k) EXPECT_NEAR(turns_m[k], expected_m[k], 0.03) << k;
}

// Along a wall with the goal behind it on the right. If the wall blocks the way to the goal, the vehicle first turns
// left to fly on, the next time right to fly back, until it is 3 m away.
TEST(TurnBack, TriesTheWayAheadThenTheWayBehindIfTheWayToTheGoalIsBlocked) {
  for (const double right : {-1.0, 1.0}) {
    TurnBack turn_back;
    const Eigen::Vector2d goal(0.0, 30.0 * right);
    std::vector<double> sides;
    double left_at_m = -30.0;
    for (double north_m = -20.0; north_m < 40.0; north_m += 0.1) {
      if (turns(turn_back, goal, {north_m, 0.0}, 0.0)) {
        EXPECT_EQ(turn_back.side(), right) << "towards the goal";
        EXPECT_FALSE(turns(turn_back, goal, {north_m, 0.0}, std::atan2(goal.y(), -north_m)));
        sides.push_back(turn_back.side().value_or(0.0) * right);
        left_at_m = north_m;
      } else if (north_m > left_at_m + 3.05) {
        EXPECT_FALSE(turn_back.side()) << north_m;
      } else if (north_m < left_at_m + 2.95) {
        EXPECT_EQ(turn_back.side().value_or(0.0) * right, sides.back()) << north_m;
      }
    }
    EXPECT_EQ(sides, (std::vector<double>{-1.0, 1.0, -1.0, 1.0})) << right;
  }
}

TEST(TurnBack, SuccessfulTurnResetsTheDistance) {
  TurnBack turn_back;
  for (const double aside_m : {9.0, 6.0, 0.0}) {
    EXPECT_FALSE(turn_back.update({0.0, 0.0, 20.0}, {}));
    double passed_m = -10.0;
    while (passed_m < 20.0 && !turn_back.update({aside_m, 0.0, -passed_m}, {})) passed_m += 0.1;
    // One meter behind and 0.3 m farther than the minimum distance.
    EXPECT_NEAR(passed_m, std::max(1.0, std::sqrt(0.09 + 0.6 * aside_m)), 0.11) << aside_m;
  }
}

}  // namespace
}  // namespace hedgehop::avoidance::stereo_corridor
