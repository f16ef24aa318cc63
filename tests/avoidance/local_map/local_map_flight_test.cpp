#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/avoidance/local_map/point_world.h"

namespace hedgehop::avoidance::local_map {
namespace {

/// HEDGEHOP_POINT_FLIGHTS=10000 flies the property as often as it is claimed; the suite flies a sample.
int point_flights() {
  const char* const asked = std::getenv("HEDGEHOP_POINT_FLIGHTS");
  return asked ? std::atoi(asked) : 10;
}

// A stop is always possible in known free space: [Tordesillas2019] sec. I.
TEST(LocalMapFlight, NoPointCollidesInRandomWorldsWithPerfectDepth) {
  const int flights = point_flights();
  int reached = 0;
  for (int seed = 1; seed <= flights; ++seed) {
    const PointWorld::Flown flown = random_world(static_cast<uint64_t>(seed)).fly({});
    EXPECT_GT(flown.clearance_m, 0.0) << seed;
    reached += flown.reached;
  }
  std::printf("%d flights, %d reached\n", flights, reached);
  EXPECT_GE(reached, 0.95 * flights);
}

TEST(LocalMapFlight, AVehicleOfTheHexacoptersSizeDoesNotEither) {
  constexpr double kRadiusM = 0.65;
  for (uint64_t seed = 101; seed <= 104; ++seed) {
    PointWorld world = random_world(seed);
    world.radius_m = kRadiusM;
    EXPECT_GT(world.fly({}).clearance_m, 0.0) << seed;
  }
}

TEST(LocalMapFlight, InTheOpenItFliesEightMetersASecond) {
  PointWorld world;
  world.goal_W = {70.0, 0.0};
  LocalMapConfig config;
  config.noise_px = 0.1;  // depth here is perfect, and the camera too coarse to see far with half a pixel
  const PointWorld::Flown flown = world.fly(config);
  EXPECT_TRUE(flown.reached);
  EXPECT_GT(flown.fastest_mps, 7.5);
}

TEST(LocalMapFlight, ComesOutOfADeadEnd) {
  PointWorld world;
  world.goal_W = {20.0, 0.0};
  world.walls = {{{9.0, -5.0}, {9.0, 5.0}}, {{2.0, -5.0}, {9.0, -5.0}}, {{2.0, 5.0}, {9.0, 5.0}}};
  const PointWorld::Flown flown = world.fly({});
  EXPECT_TRUE(flown.reached);
  EXPECT_GT(flown.clearance_m, 0.0);
}

TEST(LocalMapFlight, SaysThatItIsStuckWhereNoWayExists) {
  PointWorld world;
  world.goal_W = {20.0, 0.0};
  world.walls = {{{5.0, -5.0}, {5.0, 5.0}}, {{-5.0, -5.0}, {-5.0, 5.0}}, {{-5.0, -5.0}, {5.0, -5.0}}, {{-5.0, 5.0}, {5.0, 5.0}}};
  world.duration_s = 60.0;
  const PointWorld::Flown flown = world.fly({});
  EXPECT_FALSE(flown.reached);
  EXPECT_GT(flown.clearance_m, 0.0);
  EXPECT_GT(std::ranges::count(flown.statuses, "stuck"), 100);
}

}  // namespace
}  // namespace hedgehop::avoidance::local_map
