#include "avoidance/flow_balance/range_balance.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "avoidance/flow_balance/balance_law.h"
#include "tests/avoidance/flow_balance/wall_flow.h"

namespace hedgehop::avoidance::flow_balance {
namespace {

TEST(PushFromRanges, EqualsThePapersPushBeforeWallsThatTheCamerasFace) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> speed(0.3, 2.0), range(2.0, 30.0);
  constexpr BalanceGains kGains{.loom_m2ps = 4.0, .flow_m2ps = 5.0};
  constexpr double kGain = kGains.loom_m2ps + kGains.flow_m2ps;
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Vector2d v_B(speed(random), -speed(random));
    std::array<SideFlow, kSideCount> sides;
    SideAxes axes_H;
    PerSide inverse_ranges_per_m;
    for (size_t i = 0; i < kSideCount; ++i) {
      const double z = range(random);
      sides[i] = flow_of_wall(level_camera("any", 0.5 * M_PI * static_cast<double>(i), 200, 50.0), v_B, z);
      axes_H[i] = sides[i].axis_H;
      inverse_ranges_per_m[i] = 1.0 / z;
    }
    const Eigen::Vector2d paper = push_from_walls(sides, v_B, kGains);
    EXPECT_LT((push_from_ranges(axes_H, inverse_ranges_per_m, kGain) - paper).norm(), 0.02 * kGain / 2.0);
  }
}

TEST(LowPass, LeavesTheShareOfTheOldCommandThatTheTimeConstantSays) {
  const Eigen::Vector2d v_W = low_pass({1.0, 0.0}, {0.0, 2.0}, 0.3, 0.3);
  EXPECT_NEAR(v_W.x(), std::exp(-1.0), 1e-12);
  EXPECT_NEAR(v_W.y(), 2.0 * (1.0 - std::exp(-1.0)), 1e-12);
  EXPECT_EQ(low_pass({1.0, 0.0}, {0.0, 2.0}, 0.3, 0.0), Eigen::Vector2d(0.0, 2.0));
}

}  // namespace
}  // namespace hedgehop::avoidance::flow_balance
