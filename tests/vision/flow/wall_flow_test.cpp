#include "vision/flow/flow_range.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace hedgehop::vision::flow {
namespace {

/// A room around B, rotated relative to H: four walls, given by the directions and distances of their nearest points.
struct Room {
  std::vector<Eigen::Vector2d> n;
  std::vector<double> d_m;

  /// Returns the distance from a point to the first wall along a ray, in lengths of the ray.
  double along(const Eigen::Vector2d& p_H, const Eigen::Vector2d& ray_H) const {
    double nearest = INFINITY;
    for (size_t k = 0; k < n.size(); ++k) {
      if (n[k].dot(ray_H) > 0.0) nearest = std::min(nearest, (d_m[k] - n[k].dot(p_H)) / n[k].dot(ray_H));
    }
    return nearest;
  }
};

Room random_room(std::mt19937_64& random) {
  std::uniform_real_distribution<double> turn(0.0, M_PI / 2.0), distance(1.2, 6.0);
  const Eigen::Rotation2Dd rotated(turn(random));
  Room room;
  for (int k = 0; k < 4; ++k) {
    room.n.emplace_back(rotated * Eigen::Rotation2Dd(k * M_PI / 2.0) * Eigen::Vector2d::UnitX());
    room.d_m.push_back(distance(random));
  }
  return room;
}

/// Returns the flow in the middle rows of four cameras, half a meter from B, while B moves, with `noise` added.
std::vector<WallFlowSample> look(const Room& room, const Eigen::Vector2d& v_H, double noise, std::mt19937_64& random) {
  constexpr int kPatches = 8;
  constexpr double kOffM = 0.4, kReach = 0.75;
  std::normal_distribution<double> error(0.0, 1.0);
  std::vector<WallFlowSample> observations;
  for (int camera = 0; camera < 4; ++camera) {
    const Eigen::Vector2d axis_H =
        Eigen::Rotation2Dd((camera - 1.5) * M_PI / 2.0 - M_PI / 4.0) * Eigen::Vector2d::UnitX();
    const Eigen::Vector2d right_H(-axis_H.y(), axis_H.x());
    const Eigen::Vector3d v_WC_C(v_H.dot(right_H), 0.0, v_H.dot(axis_H));
    for (int patch = 0; patch < kPatches; ++patch) {
      const Eigen::Vector2d place(kReach * (2.0 * patch / (kPatches - 1.0) - 1.0), 0.0);
      WallFlowSample observation;
      observation.ray_H = axis_H + place.x() * right_H;
      observation.p_BC_H = kOffM * axis_H;
      observation.unit_flow = unit_flow(place, v_WC_C);
      observation.flow = observation.unit_flow / room.along(observation.p_BC_H, observation.ray_H);
      observation.flow += noise * Eigen::Vector2d(error(random), error(random));
      observation.noise = std::max(noise, 1e-6);
      observations.push_back(observation);
    }
  }
  return observations;
}

Eigen::Vector2d random_horizontal_velocity(std::mt19937_64& random) {
  std::uniform_real_distribution<double> angle(-M_PI, M_PI), speed(0.7, 1.5);
  return speed(random) * (Eigen::Rotation2Dd(angle(random)) * Eigen::Vector2d::UnitX());
}

/// Returns the relative error of a wall: that of the best match among the walls found.
double error_of(const Room& room, size_t k, const std::vector<WallEstimate>& walls) {
  double least = INFINITY;
  for (const WallEstimate& wall : walls)
    least = std::min(least, (wall.inverse_range_per_m * room.d_m[k] - room.n[k]).norm());
  return least;
}

TEST(WallFlow, FindsTheWallsOfARoomFromAMovingVehicle) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const Room room = random_room(random);
    const auto observations = look(room, random_horizontal_velocity(random), 0.0, random);
    const auto walls = walls_from_flow(observations, 0.1);
    for (size_t k = 0; k < 4; ++k) {
      // A wall in fewer than three adjacent patches cannot be detected.
      int run = 0, longest = 0;
      for (const WallFlowSample& observation : observations) {
        const Eigen::Vector2d met_H =
            observation.p_BC_H + room.along(observation.p_BC_H, observation.ray_H) * observation.ray_H;
        run = std::abs(room.n[k].dot(met_H) - room.d_m[k]) < 1e-9 ? run + 1 : 0;
        longest = std::max(longest, run);
      }
      if (longest < 3) continue;
      EXPECT_LT(error_of(room, k, walls), 1e-3) << trial << " " << k;
    }
  }
}

// 0.1 px at 25 images per second and 200 px over 90 degrees.
TEST(WallFlow, RangeOfTheNearestWallIsWithinItsStatedError) {
  constexpr double kNoise = 0.1 * 25.0 / 100.0;
  std::mt19937_64 random(2);
  int within = 0, all = 0;
  double squares = 0.0;
  for (int trial = 0; trial < 300; ++trial) {
    const Room room = random_room(random);
    const auto walls = walls_from_flow(look(room, random_horizontal_velocity(random), kNoise, random), 0.3);
    const size_t k = static_cast<size_t>(std::ranges::min_element(room.d_m) - room.d_m.begin());
    if (room.d_m[k] > 2.0) continue;
    ++all;
    double least = INFINITY, stated = 0.0;
    for (const WallEstimate& wall : walls) {
      if (wall.inverse_range_per_m.normalized().dot(room.n[k]) < std::cos(0.3)) continue;
      const double error = std::abs(wall.inverse_range_per_m.norm() * room.d_m[k] - 1.0);
      if (error < least) stated = wall.relative_error;
      least = std::min(least, error);
    }
    within += least < 3.0 * stated;
    squares += std::min(least, 1.0) * std::min(least, 1.0);
  }
  EXPECT_GT(all, 100);
  EXPECT_GT(within, 0.95 * all);
  EXPECT_LT(std::sqrt(squares / all), 0.1);
}

TEST(WallFlow, FindsNoWallsWithoutMotionOrPatches) {
  std::mt19937_64 random(3);
  EXPECT_TRUE(walls_from_flow({}, 0.3).empty());
  const Room room = random_room(random);
  EXPECT_TRUE(walls_from_flow(look(room, Eigen::Vector2d::Zero(), 0.0, random), 0.3).empty());
  EXPECT_TRUE(walls_from_flow(look(room, Eigen::Vector2d::Zero(), 0.02, random), 0.3).empty());
}

}  // namespace
}  // namespace hedgehop::vision::flow
