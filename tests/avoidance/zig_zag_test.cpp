#include "avoidance/zig_zag.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <vector>

namespace hedgehop::avoidance {
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

TEST(ZigZag, WantsItsConfirmationsInARowOfFreshPictures) {
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

TEST(NearOnceStopped, LeavesTheRangeLessTheStoppingDistance) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> range(0.5, 20.0), speed(-3.0, 3.0), braking(0.3, 4.0);
  for (int i = 0; i < 1000; ++i) {
    const double range_m = range(random), closing_mps = speed(random), a_mps2 = braking(random);
    const double closing = std::max(0.0, closing_mps), left_m = range_m - closing * closing / (2.0 * a_mps2);
    const double near = near_once_stopped_per_m(1.0 / range_m, closing_mps, a_mps2);
    if (left_m > 1e-3) {
      EXPECT_NEAR(near * left_m, 1.0, 1e-9);
    } else {
      EXPECT_EQ(near, 1000.0);
    }
  }
}

TEST(NearOnceStopped, WhatIsFarStaysFar) { EXPECT_EQ(near_once_stopped_per_m(0.0, 3.0, 1.0), 0.0); }

}  // namespace
}  // namespace hedgehop::avoidance
