#include "avoidance/flow_balance/modified_balance.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "avoidance/flow_balance/balance_law.h"
#include "avoidance/flow_balance/side_cameras.h"
#include "tests/avoidance/flow_balance/wall_flow.h"

namespace hedgehop::avoidance::flow_balance {
namespace {

using Eigen::Vector2d;

constexpr int64_t kTenthNs = 100'000'000;
constexpr double kTenthS = 0.1;

Vector2d nearest(const std::vector<Vector2d>& obstacles_W) {
  return *std::ranges::min_element(obstacles_W, {}, [](const Vector2d& p) { return p.norm(); });
}

RangeColumn column_at(const Vector2d& p_BP_H, double weight = 1.0) {
  return {.direction_H = p_BP_H.normalized(), .inverse_range_per_m = 1.0 / p_BP_H.norm(), .weight = weight};
}

TEST(RangeRing, MovesAPointOutOfViewWithTheMotionOfTheVehicle) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> meters(-20.0, 20.0), mps(-3.0, 3.0);
  for (int trial = 0; trial < 50; ++trial) {
    const Vector2d p_WP(meters(random), meters(random));
    RangeRing ring;
    ring.carry({0.0, 0.0}, 0);
    ring.add({column_at(p_WP)}, 0.0);
    Vector2d p_WB(0.0, 0.0);
    for (int step = 1; step <= 20; ++step) {
      const Vector2d v_W(mps(random), mps(random));
      p_WB += kTenthS * v_W;
      ring.carry(v_W, step * kTenthNs);
    }
    ASSERT_EQ(ring.obstacles_W().size(), 1u);
    EXPECT_LT((ring.obstacles_W()[0] - (p_WP - p_WB)).norm(), 1e-9);
  }
}

TEST(RangeRing, DeletesAnOldPoint) {
  RangeRing ring;
  ring.carry({0.0, 0.0}, 0);
  ring.add({column_at({5.0, 0.0})}, 0.0);
  ring.carry({0.0, 0.0}, RangeRing::kKeepNs);
  EXPECT_EQ(ring.obstacles_W().size(), 1u);
  ring.carry({0.0, 0.0}, RangeRing::kKeepNs + 1);
  EXPECT_TRUE(ring.obstacles_W().empty());
}

TEST(RangeRing, AcceptsAColumnWithParallaxAndDoesNotTrustOneWithout) {
  RangeRing ring;
  ring.carry({0.0, 0.0}, 0);
  ring.add({column_at({5.0, 0.0})}, 0.0);
  ring.add({{.direction_H = {1.0, 0.0}, .inverse_range_per_m = 0.0, .weight = 0.1}}, 0.0);
  ASSERT_EQ(ring.obstacles_W().size(), 1u) << "no parallax: a missing range is no free space";
  ring.add({column_at({9.0, 0.0}, /*weight=*/0.1)}, 0.0);
  EXPECT_DOUBLE_EQ(nearest(ring.obstacles_W()).norm(), 5.0);
  ring.add({column_at({9.0, 0.0})}, 0.0);
  EXPECT_DOUBLE_EQ(nearest(ring.obstacles_W()).norm(), 9.0);
  ring.add({{.direction_H = {1.0, 0.0}, .inverse_range_per_m = 0.0, .weight = 1.0}}, 0.0);
  EXPECT_TRUE(ring.obstacles_W().empty());
}

TEST(RangeRing, RotatesColumnsByTheHeading) {
  RangeRing ring;
  ring.carry({0.0, 0.0}, 0);
  ring.add({column_at({0.0, 6.0})}, M_PI / 4);  // right of a nose that points north-east
  EXPECT_LT((nearest(ring.obstacles_W()) - 6.0 * Vector2d(-std::sqrt(0.5), std::sqrt(0.5))).norm(), 1e-12);
}

TEST(PushFromObstacles, EqualsThePushOfThePaperForWallsAtRightAnglesToTheCameras) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> speed(0.3, 2.0), range(2.0, 30.0);
  constexpr BalanceGains kGains{.loom_m2ps = 4.0, .flow_m2ps = 5.0};
  constexpr double kGain = kGains.loom_m2ps + kGains.flow_m2ps;
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Vector2d v_B(speed(random), -speed(random));
    std::array<SideFlow, kSideCount> sides;
    std::vector<Eigen::Vector2d> obstacles_W;  // three at the foot of each wall; B equals W
    for (size_t i = 0; i < kSideCount; ++i) {
      const double z = range(random);
      sides[i] = flow_of_wall(level_camera("any", 0.5 * M_PI * static_cast<double>(i), 200, 50.0), v_B, z);
      obstacles_W.insert(obstacles_W.end(), 3, z * sides[i].axis_H);
    }
    const Eigen::Vector2d paper = push_from_walls(sides, v_B, kGains);
    EXPECT_LT((push_from_obstacles(obstacles_W, Eigen::Vector2d::UnitX(), kGain) - paper).norm(), 0.02 * kGain / 2.0);
  }
}

TEST(PushFromObstacles, RotatesWithTheWorldAndTheAim) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> meters(-20.0, 20.0), angle(-M_PI, M_PI);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Eigen::Vector2d> obstacles_W, turned_W;
    const Eigen::Rotation2Dd turn(angle(random));
    for (int i = 0; i < 20; ++i) {
      obstacles_W.emplace_back(meters(random), meters(random));
      turned_W.push_back(turn * obstacles_W.back());
    }
    const Eigen::Vector2d aim_W(meters(random), meters(random));
    const Eigen::Vector2d expected_W = turn * push_from_obstacles(obstacles_W, aim_W, 9.0);
    EXPECT_LT((push_from_obstacles(turned_W, turn * aim_W, 9.0) - expected_W).norm(), 1e-9 * (1.0 + expected_W.norm()));
  }
}

TEST(LowPass, KeepsTheShareOfTheOldCommandGivenByTheTimeConstant) {
  const Eigen::Vector2d v_W = low_pass({1.0, 0.0}, {0.0, 2.0}, 0.3, 0.3);
  EXPECT_NEAR(v_W.x(), std::exp(-1.0), 1e-12);
  EXPECT_NEAR(v_W.y(), 2.0 * (1.0 - std::exp(-1.0)), 1e-12);
  EXPECT_EQ(low_pass({1.0, 0.0}, {0.0, 2.0}, 0.3, 0.0), Eigen::Vector2d(0.0, 2.0));
}

constexpr double kPatienceS = 20.0;
constexpr int kPeriodS = 32;  // patience and one detour of 12 s

TEST(Detour, DoesNotChangeTheAimDuringSteadyProgress) {
  Detour detour(kPatienceS);
  for (int t = 0; t < 300; ++t) EXPECT_EQ(detour.update(300.0 - 0.5 * t, t), 0.0) << t;
  EXPECT_EQ(detour.count(), 0);
}

TEST(Detour, AimsAsideWithoutProgressAndThenToTheOtherSide) {
  Detour detour(kPatienceS);
  for (int t = 0; t < 100; ++t) {
    // 20 s of patience, 12 s to the right, 20 s of patience, 12 s to the left ...
    const double side = t / kPeriodS % 2 == 0 ? 1.0 : -1.0;
    const double expected = t % kPeriodS < kPatienceS ? 0.0 : side * Detour::kAngleRad;
    EXPECT_EQ(detour.update(100.0 + (t % 2), t), expected) << t;
  }
  EXPECT_EQ(detour.count(), 3);
}

TEST(Detour, SmallApproachInALimitCycleIsNoProgress) {
  Detour detour(kPatienceS);
  double angle = 0.0;
  for (int t = 0; t <= 20; ++t) angle = detour.update(100.0 - 0.1 * t, t);
  EXPECT_EQ(angle, Detour::kAngleRad);
}

TEST(Detour, ZeroPatienceDisablesDetours) {
  Detour detour(0.0);
  for (int t = 0; t < 1000; ++t) EXPECT_EQ(detour.update(100.0, t), 0.0);
}

}  // namespace
}  // namespace hedgehop::avoidance::flow_balance
