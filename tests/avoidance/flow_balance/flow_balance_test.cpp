#include "avoidance/flow_balance/flow_balance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "tests/avoidance/flow_balance/point_flight.h"

namespace hedgehop::avoidance::flow_balance {
namespace {

using std::numbers::pi;

FlowBalanceConfig with_small_images() {
  FlowBalanceConfig config;
  config.flow = {.rows = 6, .cols = 6, .patch_px = 24, .margin_px = 6};
  return config;
}

FlowBalanceConfig as_published() {
  FlowBalanceConfig config = with_small_images();
  config.law = Law::published;
  return config;
}

Eigen::Vector2d polar(double length, double azimuth) {
  return {length * std::cos(azimuth), length * std::sin(azimuth)};
}

// Returns the commanded velocity after a few images of steady flight at v_WB_W.
VelocityCommand command_in_flight(const FlowBalanceConfig& config, const Walls& walls, double heading_rad,
                                  const Eigen::Vector2d& v_WB_W, const Goal& goal,
                                  const Eigen::Vector3d& w_WB_B = {0, 0, 0}, double pitch_rad = 0.0) {
  constexpr double kPeriodS = 0.04;
  const auto module = make_flow_balance(config);
  const Setup setup = four_cameras(kSizePx, 1.0 / kPeriodS);
  module->reset(setup);
  VelocityCommand command;
  for (int i = 0; i < 3; ++i) {
    const int64_t t_ns = int64_t{40'000'000} * i;
    const Eigen::Vector2d p = v_WB_W * (kPeriodS * i);
    NavigationState navigation = level_flight({p.x(), p.y(), -5.0}, heading_rad + w_WB_B.z() * kPeriodS * i, v_WB_W);
    navigation.w_WB_B_est = w_WB_B;
    const Eigen::Quaterniond pitched(Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()));
    navigation.q_WB_est = navigation.q_WB_gyro = navigation.q_WB_est * pitched;
    navigation.v_WB_B_est = pitched.conjugate() * navigation.v_WB_B_est;
    const auto frames = see(setup, navigation, t_ns, walls, wavy_texture());
    command = std::get<VelocityCommand>(module->update({t_ns, frames, navigation, goal}).command);
  }
  return command;
}

class BothLaws : public testing::TestWithParam<Law> {
 protected:
  static FlowBalanceConfig config() {
    FlowBalanceConfig config = with_small_images();
    config.law = GetParam();
    return config;
  }
};
INSTANTIATE_TEST_SUITE_P(FlowBalance, BothLaws, testing::Values(Law::published, Law::modified),
                         [](const auto& law) { return law.index == 0 ? "published" : "modified"; });

TEST_P(BothLaws, TurnAwayFromAWallOnEverySideInAnyFlightDirection) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> speed(0.6, 1.6);
  int i = 0;
  for (const double heading : {0.0, pi / 8, 3.5}) {
    for (const double side : {0.0, 0.5 * pi, pi, 1.5 * pi}) {
      // The wall faces the camera; the goal lies along the wall.
      const double to_wall = heading + side;
      const Eigen::Vector2d n = polar(1.0, to_wall), along = polar(1.0, to_wall + 0.5 * pi);
      const Walls walls = {wall(5.0 * n.x(), 5.0 * n.y(), to_wall + pi)};
      const Eigen::Vector2d v = speed(random) * (++i % 2 ? 1 : -1) * n + speed(random) * along;
      const Goal goal{{100 * along.x(), 100 * along.y(), -5.0}, heading};
      const VelocityCommand command = command_in_flight(config(), walls, heading, v, goal);
      EXPECT_LT(command.v_WB_W.dot(n), -0.4) << "heading " << heading << " side " << side;
      EXPECT_GT(command.v_WB_W.dot(along), 0.3) << "heading " << heading << " side " << side;
      EXPECT_NEAR(command.v_WB_W.norm(), 2.0, 1e-9);
    }
  }
}

TEST_P(BothLaws, FlyStraightToTheGoalWithoutObstacles) {
  const Goal goal{{30, 40, -5.0}, 0.2};
  const VelocityCommand command = command_in_flight(config(), {}, 0.2, {1, 1}, goal);
  const Eigen::Vector2d left = Eigen::Vector2d(30, 40) - Eigen::Vector2d(1, 1) * 0.08;  // 0.08 s were flown
  EXPECT_LT((command.v_WB_W - 2.0 * left.normalized()).norm(), 1e-9);
}

TEST_P(BothLaws, TurnFartherFromNearerWalls) {
  double last = 0.0;
  for (const double range : {30.0, 12.0, 6.0, 3.0}) {
    const VelocityCommand command =
        command_in_flight(config(), {wall(0, range, -0.5 * pi)}, 0.0, {1.2, 0.8}, {{100, 0, -5}, 0.0});
    EXPECT_LT(command.v_WB_W.y(), last) << range;
    last = command.v_WB_W.y();
  }
}

TEST(FlowBalance, DeceleratesNearTheGoalInsteadOfCirclingIt) {
  const Walls walls = {wall(0, 6, -0.5 * pi)};
  for (const double distance : {3.0, 1.0, 0.2}) {
    const Eigen::Vector2d flown = Eigen::Vector2d(0.3, 0.2) * 0.08;  // the position of the third image
    const VelocityCommand command =
        command_in_flight(with_small_images(), walls, 0.0, {0.3, 0.2}, {{flown.x() + distance, flown.y(), -5}, 0.0});
    EXPECT_NEAR(command.v_WB_W.norm(), 2.0 * distance / 4.0, 1e-9);
  }
}

TEST(FlowBalance, SpiralAngleAimsRightOfTheGoal) {
  FlowBalanceConfig config = with_small_images();
  config.spiral_angle_rad = 0.3;
  const VelocityCommand command = command_in_flight(config, {}, 0.0, {1, 0}, {{100, 0, -5}, 0.0});
  // The vehicle has flown 0.08 m in between.
  EXPECT_NEAR(std::atan2(command.v_WB_W.y(), command.v_WB_W.x()), 0.3, 1e-3);
}

TEST(FlowBalance, CommandFilterKeepsItsShareOfTheOldCommand) {
  FlowBalanceConfig plain = with_small_images(), filtered = plain;
  filtered.command_time_constant_s = 1e9;
  const Walls walls = {wall(0, 4, -0.5 * pi)};
  const Goal goal{{100, 0, -5}, 0.0};
  EXPECT_LT(command_in_flight(plain, walls, 0.0, {1.2, 0.8}, goal).v_WB_W.y(), -0.4);
  EXPECT_NEAR(command_in_flight(filtered, walls, 0.0, {1.2, 0.8}, goal).v_WB_W.y(), 0.0, 1e-3);
}

TEST(FlowBalance, FlowOfATurnAffectsOnlyThePublishedLaw) {
  // A yaw rate causes the same flow as a wall. The modified law removes it with the gyros.
  const Walls walls = {wall(8, 0, pi), wall(-8, 0, 0)};
  const Goal goal{{0, 100, -5}, 0.0};
  const Eigen::Vector2d v(0.9, 1.2);
  const Eigen::Vector3d w(0, 0, 0.3);
  const auto change = [&](const FlowBalanceConfig& config) {
    const auto still = command_in_flight(config, walls, 0.0, v, goal).v_WB_W;
    return (command_in_flight(config, walls, 0.0, v, goal, w).v_WB_W - still).norm();
  };
  EXPECT_LT(change(with_small_images()), 0.25);  // an eighth of the speed
  EXPECT_GT(change(as_published()), 3.0 * change(with_small_images()));
}

TEST(FlowBalance, PassesABuildingOnItsPath) {
  const Walls building = {wall(12, 0, pi, 4), wall(20, 0, 0, 4), wall(16, 4, 0.5 * pi, 4), wall(16, -4, -0.5 * pi, 4)};
  const auto clearance = [](const Eigen::Vector2d& p) {
    const double north = std::abs(p.x() - 16) - 4, east = std::abs(p.y()) - 4;
    return std::hypot(std::max(north, 0.0), std::max(east, 0.0)) + std::min(std::max(north, east), 0.0);
  };
  const Goal goal{{36, 1.5, -1}, 0.0};
  const PointFlight flight =
      fly(*make_flow_balance(with_small_images()), building, 0.0, goal, {0, -1.0}, 40.0, clearance);
  EXPECT_GT(flight.least_clearance_m, 0.5);
  EXPECT_LT((flight.path.back() - goal.p_WG.head<2>()).norm(), 2.0);
  // The control run, with zero gains, flies through it.
  FlowBalanceConfig blind = with_small_images();
  blind.loom_gain_m2ps = blind.flow_gain_m2ps = 0.0;
  EXPECT_LT(fly(*make_flow_balance(blind), building, 0.0, goal, {0, -1.0}, 9.0, clearance).least_clearance_m, 0.0);
}

TEST(FlowBalance, DoesNotFlyFasterTowardAWallThanItCanStop) {
  // The push is zero, so only the limit of the approach remains: v t + v^2 / (2 a) is the distance left.
  FlowBalanceConfig config = with_small_images();
  config.loom_gain_m2ps = config.flow_gain_m2ps = 0.0;
  config.clearance_m = 1.5;
  const Eigen::Vector2d v_W(1.2, 0.8);
  const double wall_m = 5.0, flown_m = 0.08 * v_W.x();
  const VelocityCommand command = command_in_flight(config, {wall(wall_m, 0, pi)}, 0.0, v_W, {{100, 0, -5}, 0.0});
  const double v = command.v_WB_W.x(), radius_m = 1.0;  // of four_cameras()
  const double stop_m = v * config.reaction_s + v * v / (2.0 * config.braking_mps2);
  EXPECT_GT(v, 0.3);
  EXPECT_NEAR(stop_m, wall_m - flown_m - radius_m - config.clearance_m, 0.6);  // flow errs by 15 % of the range
  config.clearance_m = 0.0;
  EXPECT_NEAR(command_in_flight(config, {wall(wall_m, 0, pi)}, 0.0, v_W, {{100, 0, -5}, 0.0}).v_WB_W.x(), 2.0, 1e-2);
}

TEST(FlowBalance, PatchesAboveTheMaximumElevationMeasureNoObstacle) {
  // Only the limit of the approach remains. The image shows a wall from -45 to 45 deg, pitched up by 30 deg from -15.
  FlowBalanceConfig config = with_small_images();
  config.loom_gain_m2ps = config.flow_gain_m2ps = 0.0;
  config.clearance_m = 1.5;
  const auto speed_mps = [&config](double max_elevation_rad, double pitch_rad) {
    config.max_elevation_rad = max_elevation_rad;
    const Goal goal{{100, 0, -5}, 0.0};
    return command_in_flight(config, {wall(5.0, 0, pi)}, 0.0, {1.2, 0.8}, goal, {0, 0, 0}, pitch_rad).v_WB_W.x();
  };
  const double limited_mps = speed_mps(0.5 * pi, 0.0);
  EXPECT_LT(limited_mps, 1.3);
  EXPECT_NEAR(speed_mps(-pi / 18, 0.0), limited_mps, 0.2);
  EXPECT_NEAR(speed_mps(-pi / 3, 0.0), 2.0, 1e-2);
  EXPECT_LT(speed_mps(0.5 * pi, pi / 6), 1.3);
  EXPECT_NEAR(speed_mps(-pi / 9, pi / 6), 2.0, 1e-2);
}

TEST(FlowBalance, AnnotatesAllFourCamerasInOneImage) {
  const auto module = make_flow_balance(with_small_images());
  const avoidance::Setup setup = four_cameras(kSizePx, 25.0);
  module->reset(setup);
  EXPECT_TRUE(module->annotate().empty());
  const NavigationState navigation = level_flight({0, 0, -5}, 0.0, {1, 0});
  const auto frames = see(setup, navigation, 1, {wall(8, 0, pi)}, wavy_texture());
  module->update({1, frames, navigation, {{9, 9, -5}, 0.0}});
  const cv::Mat image = module->annotate();
  EXPECT_EQ(image.type(), CV_8UC3);
  EXPECT_GE(image.cols, 2 * kSizePx);
  EXPECT_GE(image.rows, 2 * kSizePx);
}

TEST(FlowBalance, RejectsConfigsOutOfRangeAndPatchesThatDoNotFit) {
  const auto refuse = [](auto change) {
    FlowBalanceConfig config = with_small_images();
    change(config);
    EXPECT_THROW(make_flow_balance(config), std::invalid_argument);
  };
  refuse([](auto& c) { c.speed_mps = -1.0; });
  refuse([](auto& c) { c.loom_gain_m2ps = std::nan(""); });
  refuse([](auto& c) { c.slow_radius_m = -1.0; });
  refuse([](auto& c) { c.spiral_angle_rad = 1.1; });
  refuse([](auto& c) { c.command_time_constant_s = -0.1; });
  refuse([](auto& c) { c.patience_s = -1.0; });
  refuse([](auto& c) { c.memory_s = 0.0; });
  refuse([](auto& c) { c.release_s = -0.1; });
  refuse([](auto& c) { c.clearance_m = -0.1; });
  refuse([](auto& c) { c.braking_mps2 = 0.0; });
  refuse([](auto& c) { c.reaction_s = -0.1; });
  refuse([](auto& c) { c.flow.rows = 0; });
  FlowBalanceConfig large = with_small_images();
  large.flow.patch_px = 128;
  const auto module = make_flow_balance(large);
  EXPECT_THROW(module->reset(four_cameras(kSizePx, 25.0)), std::invalid_argument);
}

}  // namespace
}  // namespace hedgehop::avoidance::flow_balance
