#include "avoidance/flow_balance/detour.h"

#include <gtest/gtest.h>

namespace hedgehop::avoidance::flow_balance {
namespace {

constexpr Detour::Config kConfig{.patience_s = 20.0, .angle_rad = 1.0, .duration_s = 10.0};

TEST(Detour, LeavesSteadyProgressAlone) {
  Detour detour(kConfig);
  for (int t = 0; t < 300; ++t) EXPECT_EQ(detour.update(300.0 - 0.5 * t, t), 0.0) << t;
  EXPECT_EQ(detour.count(), 0);
}

TEST(Detour, TurnsAsideWhenThePatienceIsOverAndToTheOtherSideWhenThatDidNotHelp) {
  Detour detour(kConfig);
  for (int t = 0; t < 100; ++t) {
    // 20 s of patience, 10 s to the right, 20 s of patience, 10 s to the left ...
    const double expected = t % 30 < 20 ? 0.0 : t / 30 % 2 == 0 ? 1.0 : -1.0;
    EXPECT_EQ(detour.update(100.0 + (t % 2), t), expected) << t;
  }
  EXPECT_EQ(detour.count(), 3);
}

TEST(Detour, ALittleNearerIsNoProgressInALimitCycle) {
  Detour detour(kConfig);
  double angle = 0.0;
  for (int t = 0; t <= 20; ++t) angle = detour.update(100.0 - 0.1 * t, t);
  EXPECT_EQ(angle, 1.0);
}

TEST(Detour, WithoutPatienceConfiguredNeverTurns) {
  Detour detour({});
  for (int t = 0; t < 1000; ++t) EXPECT_EQ(detour.update(100.0, t), 0.0);
}

}  // namespace
}  // namespace hedgehop::avoidance::flow_balance
