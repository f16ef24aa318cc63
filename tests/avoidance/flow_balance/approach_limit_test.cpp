#include "avoidance/flow_balance/approach_limit.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace hedgehop::avoidance::flow_balance {
namespace {

using Eigen::Vector2d;

constexpr ApproachLimit kLimit{.stand_off_m = 2.5, .braking_mps2 = 0.4, .reaction_s = 1.0};

TEST(ApproachLimit, AVehicleThatReactsLateAndBrakesStopsAtTheStandOff) {
  // Oracle: the stop in steps of a millisecond.
  for (const double range_m : {2.6, 3.0, 5.0, 12.0}) {
    double v_mps = closing_limit_mps(range_m, kLimit), left_m = range_m;
    constexpr int kMaxMs = 60'000;
    for (int ms = 0; ms < kMaxMs && v_mps > 0.0; ++ms) {
      left_m -= 1e-3 * v_mps;
      if (ms >= 1000) v_mps -= 1e-3 * kLimit.braking_mps2;
    }
    ASSERT_LE(v_mps, 0.0) << range_m;
    EXPECT_NEAR(left_m, kLimit.stand_off_m, 0.005) << range_m;
  }
}

TEST(ApproachLimit, RetreatsFromAnObstacleWithinTheStandOff) {
  EXPECT_EQ(closing_limit_mps(kLimit.stand_off_m, kLimit), 0.0);
  EXPECT_LT(closing_limit_mps(2.0, kLimit), -0.1);
  EXPECT_LT(closing_limit_mps(1.0, kLimit), closing_limit_mps(2.0, kLimit));
}

TEST(ApproachLimit, DoesNotChangeAVelocityWithoutObstaclesOrAwayFromThem) {
  EXPECT_EQ(limited_approach({1.2, -1.6}, {}, kLimit, 2.0), Vector2d(1.2, -1.6));
  EXPECT_EQ(limited_approach({1.2, -1.6}, {{-3.0, 0.0}, {0.0, 4.0}}, kLimit, 2.0), Vector2d(1.2, -1.6));
}

TEST(ApproachLimit, SlidesAlongAWall) {
  const Vector2d v_W = limited_approach({1.2, -1.6}, {{3.0, 0.0}}, kLimit, 2.0);
  EXPECT_NEAR(v_W.x(), closing_limit_mps(3.0, kLimit), 1e-12);
  EXPECT_NEAR(v_W.y(), -1.6, 1e-12);
}

TEST(ApproachLimit, HoldsTheLimitOfTheNearestObstacleAndTheSpeed) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> meters(-6.0, 6.0), mps(-2.0, 2.0);
  constexpr double kRounding = 1e-9;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Vector2d> obstacles_W;
    for (int i = 0; i < 10; ++i) obstacles_W.emplace_back(meters(random), meters(random));
    const Vector2d v_W = limited_approach({mps(random), mps(random)}, obstacles_W, kLimit, 20.0);
    const Vector2d nearest_W = *std::ranges::min_element(obstacles_W, {}, [](const Vector2d& p) { return p.norm(); });
    EXPECT_LE(v_W.dot(nearest_W.normalized()), closing_limit_mps(nearest_W.norm(), kLimit) + kRounding);
    EXPECT_LE(limited_approach(v_W, obstacles_W, kLimit, 0.5).norm(), 0.5 + kRounding);
  }
}

TEST(ApproachLimit, ASinglePointIsNoObstacle) {
  const std::vector<Vector2d> confirmed_W =
      confirmed_obstacles({{3.0, 0.0}, {3.0, 1.5}, {-4.0, 0.0}, {0.0, -4.0}, {1.9, -4.0}});
  EXPECT_EQ(confirmed_W, (std::vector<Vector2d>{{3.0, 0.0}, {3.0, 1.5}, {0.0, -4.0}, {1.9, -4.0}}));
  EXPECT_TRUE(confirmed_obstacles({}).empty());
}

TEST(ApproachLimit, RotatesWithTheWorldAndIgnoresTheOrderOfObstacles) {
  const Eigen::Rotation2Dd turn(0.7);
  const std::vector<Vector2d> obstacles_W = {{3.0, 0.5}, {2.7, -2.0}, {0.5, 3.5}};
  std::vector<Vector2d> turned_W;
  for (const Vector2d& p : obstacles_W) turned_W.insert(turned_W.begin(), turn * p);
  const Vector2d v_W(1.6, 1.2);
  const Vector2d expected_W = turn * limited_approach(v_W, obstacles_W, kLimit, 2.0);
  EXPECT_LT((limited_approach(turn * v_W, turned_W, kLimit, 2.0) - expected_W).norm(), 1e-12);
}

}  // namespace
}  // namespace hedgehop::avoidance::flow_balance
