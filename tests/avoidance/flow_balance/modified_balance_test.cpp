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
constexpr RangeRing::Options kRing{.memory_s = 4.0, .release_s = 0.3};

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
    RangeRing ring(kRing);
    ring.carry({0.0, 0.0}, 0);
    ring.add({column_at(p_WP)}, 0.0, kTenthS);
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
  RangeRing ring(kRing);
  ring.carry({0.0, 0.0}, 0);
  ring.add({column_at({5.0, 0.0})}, 0.0, kTenthS);
  ring.carry({0.0, 0.0}, 4'000'000'000);
  EXPECT_EQ(ring.obstacles_W().size(), 1u);
  ring.carry({0.0, 0.0}, 4'000'000'001);
  EXPECT_TRUE(ring.obstacles_W().empty());
}

RangeColumn nothing_ahead(double weight) {
  return {.direction_H = {1.0, 0.0}, .inverse_range_per_m = 0.0, .weight = weight};
}

TEST(RangeRing, DoesNotReleaseAPointWithoutParallax) {
  RangeRing ring(kRing);
  ring.carry({0.0, 0.0}, 0);
  ring.add({column_at({5.0, 0.0})}, 0.0, kTenthS);
  for (int i = 0; i < 100; ++i) {
    ring.add({nothing_ahead(/*weight=*/0.1)}, 0.0, kTenthS);
    ring.add({column_at({9.0, 0.0}, /*weight=*/0.1)}, 0.0, kTenthS);
  }
  ASSERT_EQ(ring.obstacles_W().size(), 1u) << "no parallax: a missing range is no free space";
  EXPECT_DOUBLE_EQ(nearest(ring.obstacles_W()).norm(), 5.0);
}

TEST(RangeRing, AcceptsANearerObstacleAtOnceAndReleasesItExponentially) {
  RangeRing ring(kRing);
  ring.carry({0.0, 0.0}, 0);
  ring.add({column_at({9.0, 0.0})}, 0.0, kTenthS);
  ring.add({column_at({5.0, 0.0})}, 0.0, kTenthS);
  EXPECT_DOUBLE_EQ(nearest(ring.obstacles_W()).norm(), 5.0);
  for (int i = 1; i <= 10; ++i) {
    ring.add({column_at({9.0, 0.0})}, 0.0, kTenthS);
    const double expected_per_m = 1.0 / 9.0 + (1.0 / 5.0 - 1.0 / 9.0) * std::exp(-i * kTenthS / kRing.release_s);
    EXPECT_NEAR(1.0 / nearest(ring.obstacles_W()).norm(), expected_per_m, 1e-12) << i;
  }
}

TEST(RangeRing, WithoutReleaseTimeTheLastMeasurementCounts) {
  RangeRing ring({.memory_s = 4.0, .release_s = 0.0});
  ring.carry({0.0, 0.0}, 0);
  ring.add({column_at({5.0, 0.0})}, 0.0, kTenthS);
  ring.add({column_at({9.0, 0.0})}, 0.0, kTenthS);
  EXPECT_DOUBLE_EQ(nearest(ring.obstacles_W()).norm(), 9.0);
  ring.add({nothing_ahead(/*weight=*/1.0)}, 0.0, kTenthS);
  EXPECT_TRUE(ring.obstacles_W().empty());
}

TEST(RangeRing, OneWrongImageDoesNotDeleteABuildingButLastingFreeSpaceDoes) {
  RangeRing ring(kRing);
  ring.carry({0.0, 0.0}, 0);
  ring.add({column_at({5.0, 0.0})}, 0.0, kTenthS);
  ring.add({nothing_ahead(/*weight=*/1.0)}, 0.0, 0.04);
  ASSERT_EQ(ring.obstacles_W().size(), 1u);
  EXPECT_LT(nearest(ring.obstacles_W()).norm(), 6.0);
  for (int i = 0; i < 20; ++i) ring.add({nothing_ahead(/*weight=*/1.0)}, 0.0, 0.04);
  EXPECT_TRUE(ring.obstacles_W().empty()) << "0.84 s without the building";
}

// A corner leaves the view of the left camera (patches of 10 degrees up to a bearing of -50 degrees) and enters that of
// the front camera at -40 degrees. The oracle is the closed form of its position.
TEST(RangeRing, HoldsACornerThatPassesThroughTheGapBetweenTwoCameras) {
  constexpr double kDegree = M_PI / 180.0, kHalfPatchRad = 5.0 * kDegree;
  const Vector2d p_WP(4.0, -7.0), v_W(-0.2, -1.2);
  const double patch_error_m = 2.0 * kHalfPatchRad * p_WP.norm();
  RangeRing ring(kRing);
  int images_in_gap = 0;
  for (int step = 0; step <= 30; ++step) {
    const Vector2d p_BP_W = p_WP - step * kTenthS * v_W;
    const double bearing_rad = std::atan2(p_BP_W.y(), p_BP_W.x());
    std::vector<RangeColumn> columns;
    for (int degrees = -125; degrees <= 35; degrees += 5) {
      if (degrees > -55 && degrees < -35) continue;
      const double patch_rad = degrees * kDegree;
      const bool sees_corner = std::abs(patch_rad - bearing_rad) <= kHalfPatchRad;
      columns.push_back({{std::cos(patch_rad), std::sin(patch_rad)}, sees_corner ? 1.0 / p_BP_W.norm() : 0.0, 1.0});
    }
    ring.carry(v_W, step * kTenthNs);
    ring.add(columns, 0.0, kTenthS);
    images_in_gap += bearing_rad > -50.0 * kDegree && bearing_rad < -40.0 * kDegree;
    const auto obstacles_W = ring.obstacles_W();
    EXPECT_TRUE(
        std::ranges::any_of(obstacles_W, [&](const Vector2d& p) { return (p - p_BP_W).norm() <= patch_error_m; }))
        << "bearing " << bearing_rad / kDegree;
  }
  EXPECT_GT(images_in_gap, 8);
}

TEST(RangeRing, RotatesColumnsByTheHeading) {
  RangeRing ring(kRing);
  ring.carry({0.0, 0.0}, 0);
  ring.add({column_at({0.0, 6.0})}, M_PI / 4, kTenthS);  // right of a nose that points north-east
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
  for (int t = 0; t < 2 * kPeriodS; ++t) {
    // 20 s of patience, 12 s to the right, 20 s of patience, 12 s to the left
    const double side = t / kPeriodS % 2 == 0 ? 1.0 : -1.0;
    const double expected = t % kPeriodS < kPatienceS ? 0.0 : side * Detour::kAngleRad;
    EXPECT_EQ(detour.update(100.0 + (t % 2), t), expected) << t;
  }
  EXPECT_EQ(detour.count(), 2);
}

TEST(Detour, DoublesDetoursUntilThereIsProgress) {
  Detour detour(kPatienceS);
  auto duration_s = [&, t = 0, distance_m = 100.0](bool progress) mutable {
    if (progress) distance_m -= 10.0;
    constexpr int kMaxS = 10'000;  // several times all detours
    while (t < kMaxS && detour.update(distance_m, t) == 0.0) ++t;
    const int begin = t;
    while (t < kMaxS && detour.update(distance_m, t) != 0.0) ++t;
    return t < kMaxS ? t - begin : kMaxS;
  };
  for (const int expected : {12, 12, 24, 24, 48, 48, 96, 96, 96}) EXPECT_EQ(duration_s(false), expected);
  EXPECT_EQ(duration_s(true), 12);
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
