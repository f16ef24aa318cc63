#include "avoidance/flow_balance/detour.h"

#include <gtest/gtest.h>

namespace hedgehop::avoidance::flow_balance {
namespace {

constexpr double kPatienceS = 20.0;
constexpr int kPeriodS = 32;  // patience and one detour of 12 s

TEST(Detour, LeavesSteadyProgressAlone) {
  Detour detour(kPatienceS);
  for (int t = 0; t < 300; ++t) EXPECT_EQ(detour.update(300.0 - 0.5 * t, t), 0.0) << t;
  EXPECT_EQ(detour.count(), 0);
}

TEST(Detour, AimsAsideWhenThePatienceIsOverAndToTheOtherSideWhenThatDidNotHelp) {
  Detour detour(kPatienceS);
  for (int t = 0; t < 100; ++t) {
    // 20 s of patience, 12 s to the right, 20 s of patience, 12 s to the left ...
    const double side = t / kPeriodS % 2 == 0 ? 1.0 : -1.0;
    const double expected = t % kPeriodS < kPatienceS ? 0.0 : side * Detour::kAngleRad;
    EXPECT_EQ(detour.update(100.0 + (t % 2), t), expected) << t;
  }
  EXPECT_EQ(detour.count(), 3);
}

TEST(Detour, ALittleNearerIsNoProgressInALimitCycle) {
  Detour detour(kPatienceS);
  double angle = 0.0;
  for (int t = 0; t <= 20; ++t) angle = detour.update(100.0 - 0.1 * t, t);
  EXPECT_EQ(angle, Detour::kAngleRad);
}

TEST(Detour, WithoutPatienceConfiguredNeverAimsAside) {
  Detour detour(0.0);
  for (int t = 0; t < 1000; ++t) EXPECT_EQ(detour.update(100.0, t), 0.0);
}

}  // namespace
}  // namespace hedgehop::avoidance::flow_balance
