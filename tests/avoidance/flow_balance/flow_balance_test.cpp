#include "avoidance/flow_balance/flow_balance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>

#include "tests/avoidance/flow_balance/flow_rig.h"

namespace hedgehop::avoidance::flow_balance {
namespace {

using std::numbers::pi;
using Walls = std::vector<vision::TexturedPlane>;
constexpr int kSizePx = 96;

FlowBalanceConfig small_images() {
  FlowBalanceConfig config;
  config.flow.rows = config.flow.cols = 6;
  config.flow.patch_px = 24;
  config.flow.margin_px = 6;
  config.flow.reduction = 1;
  return config;
}

const vision::WaveTexture& texture() {
  static const vision::WaveTexture made(4, 0.5, 4.0, 6);
  return made;
}

Eigen::Vector2d polar(double length, double azimuth) {
  return {length * std::cos(azimuth), length * std::sin(azimuth)};
}

// The velocity commanded after a few images of steady flight at v_WB_W.
VelocityCommand command_in_flight(const FlowBalanceConfig& config, const Walls& walls, double heading_rad,
                                  const Eigen::Vector2d& v_WB_W, const Goal& goal,
                                  const Eigen::Vector3d& w_WB_B = {0, 0, 0}) {
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
    const auto frames = see(setup, navigation, t_ns, walls, texture());
    command = std::get<VelocityCommand>(module->update({t_ns, frames, navigation, goal}).command);
  }
  return command;
}

TEST(FlowBalance, TurnsAwayFromAWallOnEverySideWhereverItFlies) {
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
      const VelocityCommand command = command_in_flight(small_images(), walls, heading, v, goal);
      EXPECT_LT(command.v_WB_W.dot(n), -0.4) << "heading " << heading << " side " << side;
      EXPECT_GT(command.v_WB_W.dot(along), 0.3) << "heading " << heading << " side " << side;
      EXPECT_NEAR(command.v_WB_W.norm(), 2.0, 1e-9);
    }
  }
}

TEST(FlowBalance, FliesStraightToTheGoalWithNothingInSight) {
  const Goal goal{{30, 40, -5.0}, 0.2};
  const VelocityCommand command = command_in_flight(small_images(), {}, 0.2, {1, 1}, goal);
  const Eigen::Vector2d left = Eigen::Vector2d(30, 40) - Eigen::Vector2d(1, 1) * 0.08;  // 0.08 s were flown
  EXPECT_LT((command.v_WB_W - 2.0 * left.normalized()).norm(), 1e-9);
}

TEST(FlowBalance, NearerWallsAreGivenAWiderBerth) {
  double last = 0.0;
  for (const double range : {30.0, 12.0, 6.0, 3.0}) {
    const VelocityCommand command =
        command_in_flight(small_images(), {wall(0, range, -0.5 * pi)}, 0.0, {1.2, 0.8}, {{100, 0, -5}, 0.0});
    EXPECT_LT(command.v_WB_W.y(), last) << range;
    last = command.v_WB_W.y();
  }
}

TEST(FlowBalance, SlowsTowardsTheGoalInsteadOfCirclingIt) {
  const Walls walls = {wall(0, 6, -0.5 * pi)};
  for (const double distance : {3.0, 1.0, 0.2}) {
    const Eigen::Vector2d flown = Eigen::Vector2d(0.3, 0.2) * 0.08;  // the position of the third image
    const VelocityCommand command =
        command_in_flight(small_images(), walls, 0.0, {0.3, 0.2}, {{flown.x() + distance, flown.y(), -5}, 0.0});
    EXPECT_NEAR(command.v_WB_W.norm(), 2.0 * distance / 4.0, 1e-9);
  }
}

TEST(FlowBalance, SpiralAngleAimsRightOfTheGoal) {
  FlowBalanceConfig config = small_images();
  config.spiral_angle_rad = 0.3;
  const VelocityCommand command = command_in_flight(config, {}, 0.0, {1, 0}, {{100, 0, -5}, 0.0});
  // The vehicle has flown 0.08 m meanwhile.
  EXPECT_NEAR(std::atan2(command.v_WB_W.y(), command.v_WB_W.x()), 0.3, 1e-3);
}

TEST(FlowBalance, CommandFilterLeavesItsShareOfTheOldCommand) {
  FlowBalanceConfig plain = small_images(), filtered = plain;
  filtered.command_time_constant_s = 1e9;
  const Walls walls = {wall(0, 4, -0.5 * pi)};
  const Goal goal{{100, 0, -5}, 0.0};
  EXPECT_LT(command_in_flight(plain, walls, 0.0, {1.2, 0.8}, goal).v_WB_W.y(), -0.4);
  EXPECT_NEAR(command_in_flight(filtered, walls, 0.0, {1.2, 0.8}, goal).v_WB_W.y(), 0.0, 1e-3);
}

TEST(FlowBalance, SkyDilutesAWallWhenItCountsAsFarAway) {
  // A wall in the middle third of the left camera's view, open country beside it.
  const Walls walls = {wall(0.0, -5.0, 0.5 * pi, 1.0)};
  FlowBalanceConfig all = small_images();
  all.loom_gain_m2ps = all.flow_gain_m2ps = 1.0;
  FlowBalanceConfig valid = all;
  valid.average = FlowBalanceConfig::Average::valid;
  const Goal goal{{100, 0, -5}, 0.0};
  const double push_all = command_in_flight(all, walls, 0.0, {1.5, -0.7}, goal).v_WB_W.y();
  const double push_valid = command_in_flight(valid, walls, 0.0, {1.5, -0.7}, goal).v_WB_W.y();
  EXPECT_GT(push_all, 0.1);
  EXPECT_GT(push_valid, 1.2 * push_all);
}

TEST(FlowBalance, DerotationTakesOutTheFlowOfATurn) {
  // Yaw rate makes flow that looks like a wall's; the open space to the rear shows how much is left.
  const Walls walls = {wall(8, 0, pi), wall(-8, 0, 0)};
  FlowBalanceConfig plain = small_images(), derotated = plain;
  derotated.derotate = true;
  const Goal goal{{0, 100, -5}, 0.0};
  const Eigen::Vector2d v(0.9, 1.2);
  const Eigen::Vector3d w(0, 0, 0.3);
  const auto still = command_in_flight(derotated, walls, 0.0, v, goal).v_WB_W;
  const auto corrected = command_in_flight(derotated, walls, 0.0, v, goal, w).v_WB_W;
  const auto disturbed = command_in_flight(plain, walls, 0.0, v, goal, w).v_WB_W;
  EXPECT_LT((corrected - still).norm(), 0.2);
  EXPECT_GT((disturbed - still).norm(), 3.0 * (corrected - still).norm());
}

// A point mass that follows the command with a lag, seen by small cameras ten times a second.
struct PointFlight {
  double least_clearance_m = 1e9;
  std::vector<Eigen::Vector2d> path;
  std::vector<Metric> metrics;
};

template <class Clearance>
PointFlight fly(const FlowBalanceConfig& config, const Walls& walls, double heading_rad, const Goal& goal,
                Eigen::Vector2d p, double duration_s, Clearance clearance) {
  constexpr double kPeriodS = 0.1, kLagS = 0.4;
  const auto module = make_flow_balance(config);
  const Setup setup = four_cameras(kSizePx, 1.0 / kPeriodS);
  module->reset(setup);
  PointFlight flight;
  Eigen::Vector2d v = Eigen::Vector2d::Zero();
  for (int i = 0; i * kPeriodS < duration_s; ++i) {
    const int64_t t_ns = int64_t{100'000'000} * i;
    const NavigationState navigation = level_flight({p.x(), p.y(), -1.0}, heading_rad, v);
    const auto frames = see(setup, navigation, t_ns, walls, texture());
    const auto command = std::get<VelocityCommand>(module->update({t_ns, frames, navigation, goal}).command);
    p += v * kPeriodS;
    v += (command.v_WB_W - v) * (kPeriodS / kLagS);
    flight.path.push_back(p);
    flight.least_clearance_m = std::min(flight.least_clearance_m, clearance(p));
  }
  flight.metrics = module->metrics();
  return flight;
}

TEST(FlowBalance, SimpleSchemeZigZagsThroughTheRoomWithoutTouching) {
  // [Garratt2009] sec. 4: 8 m x 16 m, heading along the long walls and 22.5 degrees off.
  const Walls room = {wall(8, 0, pi), wall(-8, 0, 0), wall(0, 4, -0.5 * pi), wall(0, -4, 0.5 * pi)};
  FlowBalanceConfig config = small_images();
  config.scheme = FlowBalanceConfig::Scheme::simple;
  config.flow.rows = 1;
  config.flow.cols = 8;
  for (const double heading : {0.0, pi / 8}) {
    const PointFlight flight =
        fly(config, room, heading, {{0, 0, -1}, heading}, {-5.0, 0.5}, 40.0,
            [](const Eigen::Vector2d& p) { return std::min(8.0 - std::abs(p.x()), 4.0 - std::abs(p.y())); });
    EXPECT_GT(flight.least_clearance_m, 0.4) << heading;
    double north = 0.0, east = 0.0;
    for (const Eigen::Vector2d& p : flight.path) {
      north = std::max(north, std::abs(p.x()));
      east = std::max(east, std::abs(p.y()));
    }
    EXPECT_GT(north, 5.0) << heading;  // it reaches both ends and sides
    EXPECT_GT(east, 1.5) << heading;
    EXPECT_EQ(flight.metrics.back().name, "reversals");
    EXPECT_GT(flight.metrics.back().value, 6.0);
    EXPECT_LT(flight.metrics.back().value, 60.0);
  }
}

TEST(FlowBalance, SimpleSchemeRangingPatchByPatchFillsTheRoomCloserToItsWalls) {
  const Walls room = {wall(8, 0, pi), wall(-8, 0, 0), wall(0, 4, -0.5 * pi), wall(0, -4, 0.5 * pi)};
  FlowBalanceConfig config = small_images();
  config.scheme = FlowBalanceConfig::Scheme::simple;
  config.ranging = FlowBalanceConfig::Ranging::nearest;
  config.flow.rows = 1;
  config.flow.cols = 8;
  config.derotate = true;
  config.divisor_floor_mps = 0.05;
  config.near_images = 1;
  config.range_memory_s = 1.0;
  config.range_threshold_m = 0.6;
  config.stray_rad = pi / 9;
  for (const double heading : {0.0, pi / 8}) {
    const auto clearance = [](const Eigen::Vector2d& p) {
      return std::min(8.0 - std::abs(p.x()), 4.0 - std::abs(p.y()));
    };
    const PointFlight flight = fly(config, room, heading, {{0, 0, -1}, heading}, {-3.0, 0.5}, 120.0, clearance);
    EXPECT_GT(flight.least_clearance_m, 0.3) << heading;
    std::set<std::pair<int, int>> cells;
    for (const Eigen::Vector2d& p : flight.path) {
      cells.insert({static_cast<int>(std::floor(p.x() / 2.0)), static_cast<int>(std::floor(p.y() / 2.0))});
    }
    EXPECT_GE(cells.size(), 28u) << heading;  // of 8 x 4 squares of 2 m
  }
}

TEST(FlowBalance, GoalDirectedSchemePassesABuildingThatStandsInTheWay) {
  const Walls building = {wall(12, 0, pi, 4), wall(20, 0, 0, 4), wall(16, 4, 0.5 * pi, 4), wall(16, -4, -0.5 * pi, 4)};
  const auto clearance = [](const Eigen::Vector2d& p) {
    const double north = std::abs(p.x() - 16) - 4, east = std::abs(p.y()) - 4;
    return std::hypot(std::max(north, 0.0), std::max(east, 0.0)) + std::min(std::max(north, east), 0.0);
  };
  const Goal goal{{36, 1.5, -1}, 0.0};
  const PointFlight flight = fly(small_images(), building, 0.0, goal, {0, -1.0}, 40.0, clearance);
  EXPECT_GT(flight.least_clearance_m, 0.5);
  EXPECT_LT((flight.path.back() - goal.p_WG.head<2>()).norm(), 2.0);
  // The control run, gains at nothing, goes through it.
  FlowBalanceConfig blind = small_images();
  blind.loom_gain_m2ps = blind.flow_gain_m2ps = 0.0;
  EXPECT_LT(fly(blind, building, 0.0, goal, {0, -1.0}, 9.0, clearance).least_clearance_m, 0.0);
}

TEST(FlowBalance, AnnotatesAllFourCamerasInOneImage) {
  const auto module = make_flow_balance(small_images());
  const avoidance::Setup setup = four_cameras(kSizePx, 25.0);
  module->reset(setup);
  EXPECT_TRUE(module->annotate().empty());
  const NavigationState navigation = level_flight({0, 0, -5}, 0.0, {1, 0});
  const auto frames = see(setup, navigation, 1, {wall(8, 0, pi)}, texture());
  module->update({1, frames, navigation, {{9, 9, -5}, 0.0}});
  const cv::Mat image = module->annotate();
  EXPECT_EQ(image.type(), CV_8UC3);
  EXPECT_GE(image.cols, 2 * kSizePx);
  EXPECT_GE(image.rows, 2 * kSizePx);
}

TEST(FlowBalance, RefusesConfigsOutOfRangeAndPatchesThatDoNotFit) {
  const auto refuse = [](auto change) {
    FlowBalanceConfig config = small_images();
    change(config);
    EXPECT_THROW(make_flow_balance(config), std::invalid_argument);
  };
  refuse([](auto& c) { c.divisor_floor_mps = 0.0; });
  refuse([](auto& c) { c.speed_mps = -1.0; });
  refuse([](auto& c) { c.loom_gain_m2ps = std::nan(""); });
  refuse([](auto& c) { c.command_time_constant_s = -0.1; });
  refuse([](auto& c) { c.range_threshold_m = 0.0; });
  refuse([](auto& c) { c.confirmations = 0; });
  refuse([](auto& c) { c.braking_mps2 = 0.0; });
  refuse([](auto& c) { c.patience_s = -1.0; });
  refuse([](auto& c) { c.detour_duration_s = 0.0; });
  refuse([](auto& c) { c.detour_angle_rad = 0.0; });
  refuse([](auto& c) { c.way_angle_rad = 0.0; });
  refuse([](auto& c) { c.stray_rad = -0.1; });
  refuse([](auto& c) { c.range_memory_s = std::nan(""); });
  FlowBalanceConfig large = small_images();
  large.flow.patch_px = 128;
  const auto module = make_flow_balance(large);
  EXPECT_THROW(module->reset(four_cameras(kSizePx, 25.0)), std::invalid_argument);
}

}  // namespace
}  // namespace hedgehop::avoidance::flow_balance
