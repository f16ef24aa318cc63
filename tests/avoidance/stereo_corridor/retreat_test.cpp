#include "avoidance/stereo_corridor/retreat.h"

#include <gtest/gtest.h>

#include <limits>

namespace hedgehop::avoidance::stereo_corridor {
namespace {

using Eigen::Vector3d;

constexpr double kRetreatClearanceM = 1.5;

TEST(Retreat, GoesBackToTheLastPositionWithTheClearance) {
  Retreat retreat(kRetreatClearanceM);
  constexpr double kWallM = 10.0;  // ahead of the start
  std::optional<Vector3d> back;
  for (double north_m = 0.0; north_m <= 9.5; north_m += 0.25) {
    back = retreat.update({north_m, 1.0, -6.0}, kWallM - north_m);
    EXPECT_EQ(back.has_value(), kWallM - north_m < 1.2) << north_m;  // within 0.3 m of the position, it is there
  }
  ASSERT_TRUE(back);
  EXPECT_EQ(*back, Vector3d(8.5, 1.0, -6.0));
  EXPECT_FALSE(retreat.update({8.0, 1.0, -6.0}, 2.0));
}

TEST(Retreat, StaysWithoutAnObstacleOrAPositionWithTheClearance) {
  Retreat retreat(kRetreatClearanceM);
  EXPECT_FALSE(retreat.update({0.0, 0.0, -6.0}, 0.2));
  EXPECT_FALSE(retreat.update({5.0, 0.0, -6.0}, std::numeric_limits<double>::infinity()));
}

}  // namespace
}  // namespace hedgehop::avoidance::stereo_corridor
