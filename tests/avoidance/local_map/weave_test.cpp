#include "avoidance/local_map/weave.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hedgehop::avoidance::local_map {
namespace {

/// A point that flies straight to each end.
TEST(Weave, CrossesItsPositionAtRightAnglesToTheNose) {
  constexpr double kStepS = 0.1, kWeaveSpeedMps = 0.5;
  Weave weave;
  PathState now{0.0, {3.0, 4.0}, {0.0, 0.0}};
  double left_m = 0.0, right_m = 0.0;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector2d off_W = weave.target_W(now, /*heading_rad=*/0.0) - now.p_W;
    now.p_W += std::min(1.0, kWeaveSpeedMps * kStepS / off_W.norm()) * off_W;
    now.t_s += kStepS;
    left_m = std::min(left_m, now.p_W.y() - 4.0);
    right_m = std::max(right_m, now.p_W.y() - 4.0);
    EXPECT_NEAR(now.p_W.x(), 3.0, 1e-9);
  }
  EXPECT_LT(left_m, -0.3);
  EXPECT_GT(right_m, 0.3);
  EXPECT_LE(std::max(-left_m, right_m), Weave::kAsideM);
}

TEST(Weave, TurnsBackFromAnEndThatCannotBeReached) {
  Weave weave;
  const Eigen::Vector2d p_W(0.0, 0.0);
  const double first_m = weave.target_W({0.0, p_W, p_W}, 0.0).y();
  double t_s = 0.0;
  while (t_s < Weave::kLegS + 0.5) weave.target_W({t_s += 0.5, p_W, p_W}, 0.0);
  EXPECT_NEAR(weave.target_W({t_s, p_W, p_W}, 0.0).y(), -first_m, 1e-9);
}

TEST(Weave, TakesANewPositionAfterAPause) {
  Weave weave;
  weave.target_W({0.0, {0.0, 0.0}, {0.0, 0.0}}, 0.0);
  EXPECT_NEAR(weave.target_W({5.0, {7.0, 0.0}, {0.0, 0.0}}, 0.0).x(), 7.0, 1e-9);
}

}  // namespace
}  // namespace hedgehop::avoidance::local_map
