#include "avoidance/flow_balance/range_balance.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "avoidance/flow_balance/balance_law.h"
#include "avoidance/flow_balance/side_cameras.h"
#include "tests/avoidance/flow_balance/wall_flow.h"

namespace hedgehop::avoidance::flow_balance {
namespace {

TEST(PushFromPlaces, EqualsThePapersPushBeforeWallsThatTheCamerasFace) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> speed(0.3, 2.0), range(2.0, 30.0);
  constexpr BalanceGains kGains{.loom_m2ps = 4.0, .flow_m2ps = 5.0};
  constexpr double kGain = kGains.loom_m2ps + kGains.flow_m2ps;
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Vector2d v_B(speed(random), -speed(random));
    std::array<SideFlow, kSideCount> sides;
    std::vector<Eigen::Vector2d> places_W;  // three on each wall's foot; B and W agree
    for (size_t i = 0; i < kSideCount; ++i) {
      const double z = range(random);
      sides[i] = flow_of_wall(level_camera("any", 0.5 * M_PI * static_cast<double>(i), 200, 50.0), v_B, z);
      places_W.insert(places_W.end(), 3, z * sides[i].axis_H);
    }
    const Eigen::Vector2d paper = push_from_walls(sides, v_B, kGains);
    EXPECT_LT((push_from_places(places_W, Eigen::Vector2d::UnitX(), kGain) - paper).norm(), 0.02 * kGain / 2.0);
  }
}

TEST(PushFromPlaces, TurnsWithTheWorldAndTheAim) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> meters(-20.0, 20.0), angle(-M_PI, M_PI);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Eigen::Vector2d> places_W, turned_W;
    const Eigen::Rotation2Dd turn(angle(random));
    for (int i = 0; i < 20; ++i) {
      places_W.emplace_back(meters(random), meters(random));
      turned_W.push_back(turn * places_W.back());
    }
    const Eigen::Vector2d aim_W(meters(random), meters(random));
    const Eigen::Vector2d expected_W = turn * push_from_places(places_W, aim_W, 9.0);
    EXPECT_LT((push_from_places(turned_W, turn * aim_W, 9.0) - expected_W).norm(), 1e-9 * (1.0 + expected_W.norm()));
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
