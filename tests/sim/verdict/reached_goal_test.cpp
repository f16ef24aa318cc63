// The check reached_goal.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/verdict/straight_flight.h"

namespace hedgehop::sim {
namespace {

TEST(ReachedGoal, NeedsDistanceTimeAndOutcome) {
  StraightFlight f;
  EXPECT_TRUE(f.evaluate(ReachedGoalCheck{}).passed);
  EXPECT_FALSE(f.evaluate(ReachedGoalCheck{.within_m = 0.5}).passed);
  EXPECT_FALSE(f.evaluate(ReachedGoalCheck{.before_s = 19.0}).passed);
  f.flight.result.outcome = Outcome::timeout;
  f.scenario.goal->altitude_m = 14.5;  // the flight is below it
  const CheckResult low = f.evaluate(ReachedGoalCheck{});
  EXPECT_FALSE(low.passed);
  EXPECT_DOUBLE_EQ(low.value, 4.5);
  EXPECT_DOUBLE_EQ(low.limit, 3.0);
  f.flight.result.outcome = Outcome::collided;
  EXPECT_FALSE(f.evaluate(ReachedGoalCheck{}).passed);
}

/// A value next to FAIL must violate its own bound.
TEST(ReachedGoal, FailedNeverShowsAValueThatHolds) {
  StraightFlight f;
  f.flight.result.closest_obstacle.distance_m = -0.01;
  const GoalConfig before_goal;
  for (const Outcome outcome : {Outcome::reached, Outcome::collided, Outcome::timeout, Outcome::fault}) {
    for (const double distance_m : {1.0, 7.0, 30.0}) {
      for (const double altitude_m : {f.scenario.goal->altitude_m, 30.0}) {
        for (const size_t waypoints : {0, 1}) {
          StraightFlight one = f;
          one.flight.result.outcome = outcome;
          one.flight.result.goal_distance_m = distance_m;
          one.scenario.goal->altitude_m = altitude_m;
          one.scenario.route.assign(waypoints, before_goal);
          for (const ReachedGoalCheck& check :
               {ReachedGoalCheck{}, ReachedGoalCheck{.within_m = 10.0, .before_s = 19.0},
                ReachedGoalCheck{.within_m = 10.0}}) {
            const CheckResult result = one.evaluate(check);
            const bool holds = result.must == ">"    ? result.value > result.limit
                               : result.must == ">=" ? result.value >= result.limit
                                                     : result.value <= result.limit;
            EXPECT_EQ(result.passed, holds) << to_string(outcome) << ' ' << distance_m << ' ' << result.cause;
          }
        }
      }
    }
  }
}

TEST(ReachedGoal, FailsWithoutAGoal) {
  StraightFlight f;
  f.scenario.goal.reset();
  const CheckResult result = f.evaluate(ReachedGoalCheck{});
  EXPECT_FALSE(result.passed);
  EXPECT_TRUE(std::isnan(result.value));
}

}  // namespace
}  // namespace hedgehop::sim
