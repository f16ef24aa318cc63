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

TEST(ConfirmedZigZag, IsInACornerOnlyWithWallsAheadOfBothComponents) {
  const ConfirmedZigZag path = zig_zag();
  const auto in_corner = [&](double front_m, double right_m, double rear_m, double left_m) {
    return path.in_corner(sides(1.0 / front_m, 1.0 / right_m, 1.0 / rear_m, 1.0 / left_m));
  };
  EXPECT_TRUE(in_corner(1.9, 1.9, 9.0, 9.0));
  EXPECT_FALSE(in_corner(1.9, 2.1, 9.0, 9.0));
  EXPECT_FALSE(in_corner(1.9, 9.0, 1.0, 1.0));  // at first the path leads to the front and the right
}

}  // namespace
}  // namespace hedgehop::avoidance::flow_balance
