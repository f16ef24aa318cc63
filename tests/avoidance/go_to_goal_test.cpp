#include "avoidance/go_to_goal.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "tests/avoidance/flow_balance/flow_rig.h"

namespace hedgehop::avoidance {
namespace {

VelocityCommand command_at(const Eigen::Vector3d& p_WB, const Goal& goal, const GoToGoalConfig& config = {}) {
  const auto module = make_go_to_goal(config);
  module->reset(four_cameras(32, 50.0));
  Observation observation;
  observation.navigation = level_flight(p_WB, 0.4, {1.0, 0.0});
  observation.goal = goal;
  return std::get<VelocityCommand>(module->update(observation).command);
}

TEST(GoToGoal, FliesStraightAtCruiseSpeedFromAnyPosition) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-100.0, 100.0);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Vector3d p_WB(place(random), place(random), -5.0);
    const Goal goal{{place(random), place(random), -12.0}, 0.7};
    const Eigen::Vector2d way = (goal.p_WG - p_WB).head<2>();
    if (way.norm() < 4.0) continue;
    const VelocityCommand command = command_at(p_WB, goal);
    EXPECT_NEAR(command.v_WB_W.norm(), 2.0, 1e-12);
    EXPECT_NEAR(command.v_WB_W.dot(way), 2.0 * way.norm(), 1e-9);
    EXPECT_EQ(command.altitude_m, 12.0);
    EXPECT_EQ(command.heading_rad, 0.7);
  }
}

TEST(GoToGoal, DeceleratesInProportionToTheRemainingDistanceAndStops) {
  const Goal goal{{10, 0, 0}, 0.0};
  EXPECT_NEAR(command_at({6, 0, 0}, goal).v_WB_W.x(), 2.0, 1e-12);
  EXPECT_NEAR(command_at({8, 0, 0}, goal).v_WB_W.x(), 1.0, 1e-12);
  EXPECT_NEAR(command_at({9.96, 0, 0}, goal).v_WB_W.x(), 0.02, 1e-12);
  EXPECT_EQ(command_at({10, 0, 3}, goal).v_WB_W, Eigen::Vector2d::Zero());
}

TEST(GoToGoal, RejectsSpeedsAndRadiiOutOfRange) {
  EXPECT_THROW(make_go_to_goal({.speed_mps = 0.0}), std::invalid_argument);
  EXPECT_THROW(make_go_to_goal({.slow_radius_m = -1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace hedgehop::avoidance
