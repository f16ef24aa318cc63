#include "avoidance/flow_balance/balance_law.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/avoidance/flow_balance/wall_flow.h"

namespace hedgehop::avoidance::flow_balance {
namespace {

using std::numbers::pi;
constexpr BalanceGains kGains{.loom_m2ps = 4.0, .flow_m2ps = 5.0};

TEST(InverseRanges, FlowAndLoomMeasureTheRangeOfAWallOnAnySideForAnyMotion) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> speed(0.3, 2.0), range(2.0, 30.0);
  for (int trial = 0; trial < 200; ++trial) {
    const MountedCamera camera = level_camera("any", 0.5 * pi * static_cast<double>(random() % 4), 200, 50.0);
    const Eigen::Vector2d v_B((random() % 2 ? 1 : -1) * speed(random), (random() % 2 ? 1 : -1) * speed(random));
    const double z = range(random);
    const InverseRanges near = inverse_ranges(flow_of_wall(camera, v_B, z), v_B);
    EXPECT_NEAR(near.from_flow_per_m, 1.0 / z, 0.01 / z);
    EXPECT_NEAR(near.from_loom_per_m, 1.0 / z, 0.01 / z);
  }
}

TEST(InverseRanges, EqualsTheFormulasOfThePaperForEachCamera) {
  const Eigen::Vector2d v(1.3, -0.7);
  const auto near = [&](double azimuth) {
    const MountedCamera camera = level_camera("any", azimuth, 200, 50.0);
    return inverse_ranges({camera.X_BC.linear().col(2).head<2>(), camera.X_BC.linear().col(0).head<2>(), 0.1, 0.2}, v);
  };
  const std::array<InverseRanges, 4> expected = {InverseRanges{-0.1 / v.y(), 0.2 / v.x()},    // front
                                                 InverseRanges{0.1 / v.x(), 0.2 / v.y()},     // right
                                                 InverseRanges{0.1 / v.y(), -0.2 / v.x()},    // rear
                                                 InverseRanges{-0.1 / v.x(), -0.2 / v.y()}};  // left
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(near(0.5 * pi * static_cast<double>(i)).from_flow_per_m, expected[i].from_flow_per_m, 1e-12) << i;
    EXPECT_NEAR(near(0.5 * pi * static_cast<double>(i)).from_loom_per_m, expected[i].from_loom_per_m, 1e-12) << i;
  }
}

TEST(PushFromWalls, PointsAwayFromAWallOnEachSide) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> speed(0.3, 2.0);
  for (int trial = 0; trial < 100; ++trial) {
    const MountedCamera camera = level_camera("any", 0.5 * pi * static_cast<double>(random() % 4), 200, 50.0);
    const Eigen::Vector2d v_B((random() % 2 ? 1 : -1) * speed(random), (random() % 2 ? 1 : -1) * speed(random));
    const std::array sides = {flow_of_wall(camera, v_B, 5.0)};
    const Eigen::Vector2d push = push_from_walls(sides, v_B, kGains);
    EXPECT_NEAR(push.dot(sides[0].axis_H), -(4.0 + 5.0) / 5.0, 0.05);
    EXPECT_NEAR(push.dot(sides[0].right_H), 0.0, 1e-9);
  }
}

TEST(PushFromWalls, IsZeroInTheMiddleBetweenTwoWallsAndIndependentOfSpeed) {
  for (const double speed : {0.4, 1.0, 2.0}) {
    const Eigen::Vector2d v_B = speed * Eigen::Vector2d(0.8, 0.6);
    const MountedCamera left = level_camera("left", -0.5 * pi, 200, 50.0),
                        right = level_camera("right", 0.5 * pi, 200, 50.0);
    const std::array middle = {flow_of_wall(left, v_B, 4.0), flow_of_wall(right, v_B, 4.0)};
    EXPECT_LT(push_from_walls(middle, v_B, kGains).norm(), 1e-2);
    const std::array off = {flow_of_wall(left, v_B, 3.0), flow_of_wall(right, v_B, 5.0)};
    EXPECT_NEAR(push_from_walls(off, v_B, kGains).y(), 9.0 * (1 / 3.0 - 1 / 5.0), 2e-2);
  }
}

// With u the tangent of a ray's azimuth, an oblique plane has 1/z = (cos a + u sin a) / d. The means of its flow
// (u v_axis - v_right) / z give the two inverse ranges in closed form: each has a term in the ratio of the velocities.
TEST(PushFromWalls, PullsTowardAnObliqueWallIfTheVehicleMovesAlmostAcrossTheAxis) {
  constexpr double kRangeM = 5.0, kAzimuth = -22.5 * pi / 180;
  double mean_square = 0.0;  // of u, over the eight columns of the field: 139 px of a focal length of 100 px
  for (int col = 0; col < 8; ++col) mean_square += std::pow((col / 7.0 - 0.5) * 1.39, 2) / 8.0;
  const MountedCamera front = level_camera("front", 0.0, 200, 50.0);
  const auto push_along_axis = [&](double course) {
    const Eigen::Vector2d v_B(2 * std::cos(course), 2 * std::sin(course));
    const std::array sides = {flow_of_wall(front, v_B, kRangeM, kAzimuth)};
    const double ratio = v_B.y() / v_B.x(), c = std::cos(kAzimuth), s = std::sin(kAzimuth);
    const double push = push_from_walls(sides, v_B, kGains).x();
    const double from_loom = (c + s * -ratio) / kRangeM, from_flow = (c - s * mean_square / ratio) / kRangeM;
    EXPECT_NEAR(push, -4.0 * from_loom - 5.0 * from_flow, 0.02) << course;
    return push;
  };
  EXPECT_LT(push_along_axis(-38.0 * pi / 180), -0.9);  // away from the wall
  EXPECT_GT(push_along_axis(-83.0 * pi / 180), 0.5);   // toward it, although the vehicle approaches at 1 m/s
}

TEST(SaturatedDivisor, KeepsTheSignAndTheMinimumMagnitude) {
  EXPECT_EQ(saturated_divisor(1.5), 1.5);
  EXPECT_EQ(saturated_divisor(-1.5), -1.5);
  EXPECT_EQ(saturated_divisor(0.05), 0.2);
  EXPECT_EQ(saturated_divisor(-0.05), -0.2);
  EXPECT_EQ(saturated_divisor(0.0), 0.2);
}

TEST(SaturatedDivisor, BoundsThePushOfASlowVehicle) {
  const MountedCamera front = level_camera("front", 0.0, 200, 50.0);
  for (const double v : {0.01, -0.01, 0.1, -0.1}) {
    const std::array sides = {flow_of_wall(front, {v, v}, 5.0)};
    const double push = -push_from_walls(sides, {v, v}, kGains).x();
    EXPECT_GE(push, 0.0);
    EXPECT_LE(push, 9.0 / 5.0);
  }
}

TEST(NormalizedCommand, HasTheSpeedAndTheDirectionOfTheSum) {
  const Eigen::Vector2d v_H = normalized_command({2.0, 0.0}, {-2.0, 3.0}, 1.5);
  EXPECT_NEAR(v_H.x(), 0.0, 1e-12);
  EXPECT_NEAR(v_H.y(), 1.5, 1e-12);
}

TEST(NormalizedCommand, FallsBackToTheTargetIfThePushCancelsIt) {
  EXPECT_EQ(normalized_command({0.0, 2.0}, {0.0, -2.0}, 2.0), Eigen::Vector2d(0.0, 2.0));
}

}  // namespace
}  // namespace hedgehop::avoidance::flow_balance
