#include "avoidance/local_map/kept_margin.h"

#include <gtest/gtest.h>

namespace hedgehop::avoidance::local_map {
namespace {

using Detours = RouteClearance::Detours;

TEST(KeptMargin, GivesUpLongDetoursAfterFortyFiveSecondsWithoutComingNearer) {
  const Eigen::Vector2d goal_W(50.0, 0.0), next_W(-50.0, 0.0);
  KeptMargin kept(1.3, 0.3);
  EXPECT_EQ(kept.detours({0.0, 0.0}, goal_W, 0.0), Detours::long_ones);
  EXPECT_EQ(kept.detours({10.0, 0.0}, goal_W, 20.0), Detours::long_ones);
  EXPECT_EQ(kept.detours({10.0, 30.0}, goal_W, 64.0), Detours::long_ones);
  EXPECT_EQ(kept.detours({10.0, 30.0}, goal_W, 66.0), Detours::short_ones);
  EXPECT_EQ(kept.detours({20.0, 0.0}, goal_W, 70.0), Detours::short_ones);  // until it has passed a narrow passage
  EXPECT_EQ(kept.detours({20.0, 0.0}, next_W, 71.0), Detours::long_ones);
}

TEST(KeptMargin, DoesNotApplyToMarginsBelowAVoxel) {
  KeptMargin kept(0.15, 0.3);
  EXPECT_EQ(kept.detours({0.0, 0.0}, {50.0, 0.0}, 0.0), Detours::usual);
  EXPECT_EQ(kept.detours({0.0, 0.0}, {50.0, 0.0}, 100.0), Detours::usual);
  EXPECT_EQ(kept.from_unknown_m(), 0.0);
  EXPECT_GT(KeptMargin(1.3, 0.3).from_unknown_m(), 1.3);
}

}  // namespace
}  // namespace hedgehop::avoidance::local_map
