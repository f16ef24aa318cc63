#include "avoidance/flow_balance/confirmed_zig_zag.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace hedgehop::avoidance::flow_balance {
namespace {

// Inverse ranges of front, right, rear and left.
std::vector<SideRange> sides(double front, double right, double rear, double left) {
  return {{{1, 0}, front, true}, {{0, 1}, right, true}, {{-1, 0}, rear, true}, {{0, -1}, left, true}};
}

ConfirmedZigZag zig_zag(double stray_rad = 0.0) { return {{{1.0, 0.5}, 2.0}, stray_rad, 7}; }

// Adds two equal images. @return whether the second one reversed a component.
bool update_twice(ConfirmedZigZag& zig_zag, const std::vector<SideRange>& sides) {
  EXPECT_FALSE(zig_zag.update(sides));
  return zig_zag.update(sides);
}

TEST(ConfirmedZigZag, StartsForwardAndToTheRightAtTheConfiguredSpeeds) {
  EXPECT_EQ(zig_zag().velocity_H(), Eigen::Vector2d(1.0, 0.5));
}

TEST(ConfirmedZigZag, ReversesTheComponentThatLeadsTowardsAWallWithinTheThreshold) {
  ConfirmedZigZag path = zig_zag();
  EXPECT_FALSE(update_twice(path, sides(0.49, 0.49, 0.0, 0.0)));
  EXPECT_TRUE(update_twice(path, sides(0.51, 0.0, 0.0, 0.0)));
  EXPECT_EQ(path.velocity_H(), Eigen::Vector2d(-1.0, 0.5));
  EXPECT_TRUE(update_twice(path, sides(0.51, 0.51, 0.0, 0.0)));  // the vehicle already flies away from the wall ahead
  EXPECT_EQ(path.velocity_H(), Eigen::Vector2d(-1.0, -0.5));
  EXPECT_EQ(path.reversals(), 2);
}

TEST(ConfirmedZigZag, IgnoresAWallBehindTheVehicle) {
  ConfirmedZigZag path = zig_zag();
  EXPECT_FALSE(update_twice(path, sides(0.0, 0.0, 9.0, 9.0)));
  EXPECT_EQ(path.velocity_H(), Eigen::Vector2d(1.0, 0.5));
}

TEST(ConfirmedZigZag, ReversesOnlyTheNearerSideOfAWallInTwoCameras) {
  ConfirmedZigZag path = zig_zag();
  EXPECT_TRUE(update_twice(path, sides(0.8, 0.9, 0.0, 0.0)));
  EXPECT_EQ(path.velocity_H(), Eigen::Vector2d(1.0, -0.5));
}

TEST(ConfirmedZigZag, RequiresTwoSuccessiveNewImages) {
  ConfirmedZigZag path = zig_zag();
  EXPECT_FALSE(path.update(sides(0.9, 0.0, 0.0, 0.0)));
  EXPECT_FALSE(path.update(sides(0.1, 0.0, 0.0, 0.0)));
  EXPECT_FALSE(path.update(sides(0.9, 0.0, 0.0, 0.0)));
  std::vector<SideRange> stale = sides(0.9, 0.0, 0.0, 0.0);
  for (SideRange& side : stale) side.fresh = false;
  EXPECT_FALSE(path.update(stale));
  EXPECT_TRUE(path.update(sides(0.9, 0.0, 0.0, 0.0)));
}

TEST(ConfirmedZigZag, RotatesThePathWithinItsMaximumAngleAndRepeatsWithTheSeed) {
  ConfirmedZigZag one = zig_zag(0.3), same = zig_zag(0.3);
  std::set<double> forward_mps;
  double largest_rad = 0.0;
  for (int i = 0; i < 200; ++i) {
    const auto walls = i % 2 == 0 ? sides(0.9, 0.0, 0.0, 0.0) : sides(0.0, 0.0, 0.9, 0.0);
    ASSERT_TRUE(update_twice(one, walls));
    update_twice(same, walls);
    ASSERT_EQ(one.velocity_H(), same.velocity_H());
    EXPECT_NEAR(one.velocity_H().norm(), std::hypot(1.0, 0.5), 1e-12);
    const Eigen::Vector2d diagonal(i % 2 == 0 ? -1.0 : 1.0, 0.5);
    largest_rad = std::max(largest_rad, std::acos(one.velocity_H().normalized().dot(diagonal.normalized())));
    forward_mps.insert(one.velocity_H().x());
  }
  EXPECT_LE(largest_rad, 0.3 + 1e-9);
  EXPECT_GT(largest_rad, 0.28);
  EXPECT_EQ(forward_mps.size(), 200u);
}

TEST(ConfirmedZigZag, ReversesBothComponentsOnlyWithWallsAheadOfBoth) {
  const ConfirmedZigZag path = zig_zag();
  const auto reverses_both = [&](double front_m, double right_m, double rear_m, double left_m) {
    return path.reverses_both(sides(1.0 / front_m, 1.0 / right_m, 1.0 / rear_m, 1.0 / left_m), {});
  };
  EXPECT_TRUE(reverses_both(1.9, 1.9, 9.0, 9.0));
  EXPECT_FALSE(reverses_both(1.9, 2.1, 9.0, 9.0));
  EXPECT_FALSE(reverses_both(1.9, 9.0, 1.0, 1.0));  // at first the path leads to the front and the right
}

// A corner at a heading across the room: away from the wall in front, the path would lead to the wall on the left.
ConfirmedZigZag::Path beside_a_corner(const Eigen::Vector2d& v_H) {
  return {.clearance_m = v_H.x() < 0.0 && v_H.y() > 0.0 ? 0.3 : 1.0, .unvisited = 0.0};
}

TEST(ConfirmedZigZag, TurnsAwayFromBothWallsOfACornerAtOnce) {
  ConfirmedZigZag path = zig_zag();
  const auto walls = sides(0.6, 0.0, 0.0, 0.0);
  EXPECT_TRUE(path.reverses_both(walls, beside_a_corner));
  EXPECT_FALSE(path.update(walls, beside_a_corner));
  EXPECT_TRUE(path.update(walls, beside_a_corner));
  EXPECT_EQ(path.velocity_H(), Eigen::Vector2d(-1.0, -0.5));
}

TEST(ConfirmedZigZag, ChoosesThePathOverUnvisitedFloorAmongThoseThatKeepTheClearance) {
  for (const double side : {-1.0, 1.0}) {
    ConfirmedZigZag path = zig_zag(0.3);
    const Eigen::Vector2d diagonal = Eigen::Vector2d(-1.0, 0.5).normalized();
    const auto turned_rad = [&](const Eigen::Vector2d& v_H) {
      return std::atan2(diagonal.x() * v_H.y() - diagonal.y() * v_H.x(), diagonal.dot(v_H));
    };
    // More floor the further the path turns to one side, but too little clearance beyond 0.2 rad.
    const auto foresee = [&](const Eigen::Vector2d& v_H) {
      const double to_side_rad = side * turned_rad(v_H);
      return ConfirmedZigZag::Path{.clearance_m = to_side_rad > 0.2 ? 0.5 : 1.0, .unvisited = to_side_rad};
    };
    const auto walls = sides(0.9, 0.0, 0.0, 0.0);
    path.update(walls, foresee);
    ASSERT_TRUE(path.update(walls, foresee));
    const double to_side_rad = side * turned_rad(path.velocity_H());
    EXPECT_LE(to_side_rad, 0.2);
    EXPECT_GT(to_side_rad, 0.0);
  }
}

TEST(ConfirmedZigZag, TurnsBeforeTheNextWallIfOnlyAnotherPathHasUnvisitedFloor) {
  constexpr int kUpdates = 100;
  for (const double squares : {2.0, 5.0}) {
    ConfirmedZigZag path = zig_zag();
    const auto foresee = [&](const Eigen::Vector2d& v_H) {
      return ConfirmedZigZag::Path{.clearance_m = 1.0, .unvisited = v_H.x() < 0.0 && v_H.y() > 0.0 ? squares : 0.0};
    };
    for (int i = 0; i < kUpdates; ++i) path.update(sides(0.0, 0.0, 0.0, 0.0), foresee);
    const bool worth_a_turn = squares > 3.0;
    EXPECT_EQ(path.reversals(), worth_a_turn ? 1 : 0);
    EXPECT_EQ(path.velocity_H(), Eigen::Vector2d(worth_a_turn ? -1.0 : 1.0, 0.5));
  }
}

}  // namespace
}  // namespace hedgehop::avoidance::flow_balance
