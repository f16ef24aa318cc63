#include "avoidance/flow_balance/zig_zag_law.h"

#include <gtest/gtest.h>

#include <vector>

namespace hedgehop::avoidance::flow_balance {
namespace {

// Ranges of front, right, rear and left, m.
std::vector<SideRange> walls(double front_m, double right_m, double rear_m, double left_m) {
  return {{{1, 0}, 1.0 / front_m}, {{0, 1}, 1.0 / right_m}, {{-1, 0}, 1.0 / rear_m}, {{0, -1}, 1.0 / left_m}};
}

ZigZagLaw law() { return ZigZagLaw({.speed_mps = {1.0, 0.5}, .range_threshold_m = 2.0}); }

TEST(ZigZagLaw, StartsForwardAndToTheRightAtTheConfiguredSpeeds) {
  EXPECT_EQ(law().velocity_H(), Eigen::Vector2d(1.0, 0.5));
}

TEST(ZigZagLaw, ImmediatelyReversesTheComponentTowardsAWallWithinTheThreshold) {
  ZigZagLaw path = law();
  EXPECT_FALSE(path.update(walls(2.1, 2.1, 9.0, 9.0)));
  EXPECT_TRUE(path.update(walls(1.9, 2.1, 9.0, 9.0)));
  EXPECT_EQ(path.velocity_H(), Eigen::Vector2d(-1.0, 0.5));
  EXPECT_TRUE(path.update(walls(9.0, 1.9, 9.0, 9.0)));
  EXPECT_EQ(path.velocity_H(), Eigen::Vector2d(-1.0, -0.5));
  EXPECT_EQ(path.reversals(), 2);
}

TEST(ZigZagLaw, ContinuesAwayFromAWallThatIsStillNear) {
  ZigZagLaw path = law();
  EXPECT_TRUE(path.update(walls(1.5, 9.0, 9.0, 9.0)));
  EXPECT_FALSE(path.update(walls(1.2, 9.0, 9.0, 9.0)));
  EXPECT_EQ(path.velocity_H(), Eigen::Vector2d(-1.0, 0.5));
}

TEST(ZigZagLaw, ReversesBothComponentsInACorner) {
  ZigZagLaw path = law();
  EXPECT_TRUE(path.update(walls(1.5, 1.5, 9.0, 9.0)));
  EXPECT_EQ(path.velocity_H(), Eigen::Vector2d(-1.0, -0.5));
}

TEST(ZigZagLaw, TreatsNegativeRangesAsNoise) {
  ZigZagLaw path = law();
  EXPECT_FALSE(path.update(walls(-0.1, -0.1, -0.1, -0.1)));
}

}  // namespace
}  // namespace hedgehop::avoidance::flow_balance
