#include "avoidance/flow_balance/zig_zag.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <vector>

namespace hedgehop::avoidance::flow_balance {
namespace {

using Side = ZigZag::Side;

// Front, right, rear, left: one inverse range each.
std::vector<Side> sides(double front, double right, double rear, double left) {
  return {{{1, 0}, front, true}, {{0, 1}, right, true}, {{-1, 0}, rear, true}, {{0, -1}, left, true}};
}

ZigZag zig_zag(int confirmations = 1, double stray_rad = 0.0) {
  return ZigZag({{1.0, 0.5}, 2.0, confirmations, stray_rad, 7});
}

TEST(ZigZag, StartsForwardToTheRightAtItsSpeeds) { EXPECT_EQ(zig_zag().way_H(), Eigen::Vector2d(1.0, 0.5)); }

TEST(ZigZag, TurnsTheComponentThatLeadsTowardsAWallWithinTheThreshold) {
  ZigZag way = zig_zag();
  EXPECT_FALSE(way.update(sides(0.49, 0.49, 0.0, 0.0)));
  EXPECT_TRUE(way.update(sides(0.51, 0.0, 0.0, 0.0)));
  EXPECT_EQ(way.way_H(), Eigen::Vector2d(-1.0, 0.5));
  EXPECT_TRUE(way.update(sides(0.51, 0.51, 0.0, 0.0)));  // the wall ahead is left behind already
  EXPECT_EQ(way.way_H(), Eigen::Vector2d(-1.0, -0.5));
  EXPECT_EQ(way.reversals(), 2);
}

TEST(ZigZag, LeavesAWallBehindItAlone) {
  ZigZag way = zig_zag();
  EXPECT_FALSE(way.update(sides(0.0, 0.0, 9.0, 9.0)));
  EXPECT_EQ(way.way_H(), Eigen::Vector2d(1.0, 0.5));
}

TEST(ZigZag, OfAWallThatTwoCamerasSeeTurnsTheNearerSideOnly) {
  ZigZag way = zig_zag();
  EXPECT_TRUE(way.update(sides(0.8, 0.9, 0.0, 0.0)));
  EXPECT_EQ(way.way_H(), Eigen::Vector2d(1.0, -0.5));
}

TEST(ZigZag, WantsItsConfirmationsInARowOfFreshImages) {
  ZigZag way = zig_zag(2);
  EXPECT_FALSE(way.update(sides(0.9, 0.0, 0.0, 0.0)));
  EXPECT_FALSE(way.update(sides(0.1, 0.0, 0.0, 0.0)));
  EXPECT_FALSE(way.update(sides(0.9, 0.0, 0.0, 0.0)));
  std::vector<Side> stale = sides(0.9, 0.0, 0.0, 0.0);
  for (Side& side : stale) side.fresh = false;
  EXPECT_FALSE(way.update(stale));
  EXPECT_TRUE(way.update(sides(0.9, 0.0, 0.0, 0.0)));
}

TEST(ZigZag, StraysWithinItsAngleAndRepeatsWithTheSeed) {
  ZigZag one = zig_zag(1, 0.3), same = zig_zag(1, 0.3);
  std::set<double> ways;
  double largest_rad = 0.0;
  for (int i = 0; i < 200; ++i) {
    const auto walls = i % 2 == 0 ? sides(0.9, 0.0, 0.0, 0.0) : sides(0.0, 0.0, 0.9, 0.0);
    ASSERT_TRUE(one.update(walls));
    same.update(walls);
    ASSERT_EQ(one.way_H(), same.way_H());
    EXPECT_NEAR(one.way_H().norm(), std::hypot(1.0, 0.5), 1e-12);
    const Eigen::Vector2d diagonal(i % 2 == 0 ? -1.0 : 1.0, 0.5);
    largest_rad = std::max(largest_rad, std::acos(one.way_H().normalized().dot(diagonal.normalized())));
    ways.insert(one.way_H().x());
  }
  EXPECT_LE(largest_rad, 0.3 + 1e-9);
  EXPECT_GT(largest_rad, 0.28);
  EXPECT_EQ(ways.size(), 200u);
}

TEST(NearOnceStopped, LeavesTheRangeLessTheDistance) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> range(0.5, 20.0), stopping(0.0, 3.0);
  for (int i = 0; i < 1000; ++i) {
    const double range_m = range(random), distance_m = stopping(random), left_m = range_m - distance_m;
    const double near = near_once_stopped_per_m(1.0 / range_m, distance_m);
    if (left_m > 1e-3) {
      EXPECT_NEAR(near * left_m, 1.0, 1e-9);
    } else {
      EXPECT_EQ(near, 1000.0);
    }
  }
}

TEST(NearOnceStopped, WhatIsFarStaysFar) { EXPECT_EQ(near_once_stopped_per_m(0.0, 3.0), 0.0); }

// A point whose velocity turns round as a whole by a steady acceleration, in small steps.
TEST(StoppingDistance, IsHowMuchNearerATurningPointComes) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> speed(0.2, 3.0), angle(-1.5, 1.5), braking(0.3, 4.0), reaction(0.0, 1.0);
  for (int i = 0; i < 50; ++i) {
    const double speed_mps = speed(random), angle_rad = angle(random);
    const Stopping stopping{reaction(random), braking(random)};
    const Eigen::Vector2d v0 = speed_mps * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
    constexpr double kStepS = 1e-4;
    Eigen::Vector2d v = v0;
    double nearer_m = 0.0;
    for (double t_s = 0.0; v.x() > 0.0; t_s += kStepS) {
      if (t_s >= stopping.reaction_s) v -= kStepS * stopping.braking_mps2 * v0.normalized();
      nearer_m += kStepS * v.x();
    }
    EXPECT_NEAR(stopping_distance_m(v0.x(), speed_mps, stopping), nearer_m, 2e-3);
    EXPECT_EQ(stopping_distance_m(-v0.x(), speed_mps, stopping), 0.0);
  }
}

TEST(ZigZag, IsCorneredBetweenWallsAheadOfBothComponentsOnly) {
  const ZigZag zig_zag({.range_threshold_m = 2.0});
  const auto cornered = [&](double front_m, double right_m, double rear_m, double left_m) {
    const std::array<ZigZag::Side, 4> sides = {ZigZag::Side{{1, 0}, 1.0 / front_m, true},
                                               {{0, 1}, 1.0 / right_m, true},
                                               {{-1, 0}, 1.0 / rear_m, true},
                                               {{0, -1}, 1.0 / left_m, true}};
    return zig_zag.cornered(sides);
  };
  EXPECT_TRUE(cornered(1.9, 1.9, 9.0, 9.0));
  EXPECT_FALSE(cornered(1.9, 2.1, 9.0, 9.0));
  EXPECT_FALSE(cornered(1.9, 9.0, 1.0, 1.0));  // at first the way leads to the front and the right
}

}  // namespace
}  // namespace hedgehop::avoidance::flow_balance
