#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "tests/avoidance/local_map/point_world.h"

namespace hedgehop::avoidance::local_map {
namespace {

// A stop is always possible in known free space: [Tordesillas2019] sec. I.
void fly_points(uint64_t first, uint64_t last) {
  constexpr double kReached = 0.95;  // some worlds are closed
  double reached = 0.0;
  for (uint64_t seed = first; seed <= last; ++seed) {
    const PointWorld::Flown flown = random_world(seed).fly({});
    EXPECT_GT(flown.clearance_m, 0.0) << seed;
    reached += flown.reached;
  }
  EXPECT_GE(reached, kReached * static_cast<double>(last - first + 1));
}

TEST(LocalMapFlight, NoPointCollidesInRandomWorldsWithPerfectDepth) { fly_points(1, 10); }

// With a margin of 0.05 m in narrow passages, vehicles touched pillars and the ends of walls by 2 to 25 mm, because the
// edges of obstacles extended into free voxels. Such an edge takes half a voxel of the margin of 0.25 m.
TEST(LocalMapFlight, NoPointTouchesObstaclesInNarrowPassages) {
  for (const uint64_t seed : {890, 1877, 2698, 4441, 5192})
    EXPECT_GT(random_world(seed).fly({}).clearance_m, 0.1) << seed;
}

// Takes an hour; run by name.
TEST(LocalMapFlight, DISABLED_NoCollisionInTenThousandFlights) { fly_points(1, 10'000); }

TEST(LocalMapFlight, NoVehicleOfTheSizeOfTheHexacopterCollides) {
  constexpr double kRadiusM = 0.65;
  for (uint64_t seed = 101; seed <= 104; ++seed) {
    PointWorld world = random_world(seed);
    world.radius_m = kRadiusM;
    EXPECT_GT(world.fly({}).clearance_m, 0.0) << seed;
  }
}

TEST(LocalMapFlight, BlindVehicleStaysInTheSpaceAssumedFree) {
  PointWorld world;
  world.goal_W = {30.0, 0.0};
  world.radius_m = 0.65;
  world.blind_from_s = 0.0;
  const PointWorld::Flown flown = world.fly({});
  constexpr double kStripM = 4.0;  // the camera of this test sees the full height of the vehicle beyond 3 m
  for (const auto& state : flown.track) ASSERT_LT((state.p_W - world.start_W).norm(), kStripM) << state.t_s;
}

// It observes several directions, closes unknown cells and tries another route, all near its position.
TEST(LocalMapFlight, VehicleThatGoesBlindInFlightStopsNearby) {
  PointWorld world;
  world.goal_W = {60.0, 10.0};
  world.radius_m = 0.65;
  world.duration_s = 30.0;
  for (const double from_s : {2.0, 3.0, 4.0}) {
    world.blind_from_s = from_s;
    const PointWorld::Flown flown = world.fly({});
    constexpr double kStopsS = 5.0, kThereaboutsM = 4.0;
    constexpr size_t kImages = 80;
    const auto image = static_cast<size_t>((from_s + kStopsS) / PointWorld::kStepS);
    for (size_t i = image; i < image + kImages; ++i) {
      ASSERT_LT((flown.track[i].p_W - flown.track[image].p_W).norm(), kThereaboutsM)
          << from_s << ", " << flown.track[i].t_s;
    }
  }
}

TEST(LocalMapFlight, FliesAroundAWallLongerThanItsMapAndItsMemory) {
  PointWorld world;
  world.goal_W = {30.0, 0.0};
  world.walls = {{{12.0, -45.0}, {12.0, 45.0}}};
  world.duration_s = 240.0;
  const PointWorld::Flown flown = world.fly({});
  EXPECT_TRUE(flown.reached);
  EXPECT_GT(flown.clearance_m, 0.0);
}

TEST(LocalMapFlight, WithAnAftPairFliesBackImmediatelyAndClearOfObstacles) {
  PointWorld world;
  world.goal_W = {-20.0, 0.0};
  world.heading_rad = 0.0;
  world.radius_m = 0.65;
  world.pillars = {{{-10.0, 0.3}, 0.8}};
  world.duration_s = 3.0;
  const auto flown_m = [&](bool looks_aft) {
    world.looks_aft = looks_aft;
    return -world.fly({}).end_W.x();
  };
  constexpr double kFartherM = 1.5;
  EXPECT_GT(flown_m(true), flown_m(false) + kFartherM);
  world.looks_aft = true;
  world.duration_s = 60.0;
  const PointWorld::Flown flown = world.fly({});
  EXPECT_TRUE(flown.reached);
  EXPECT_GT(flown.clearance_m, 0.0);
}

TEST(LocalMapFlight, FliesSlowlyNearTheGround) {
  PointWorld world;
  world.goal_W = {30.0, 0.0};
  world.height_m = 1.5;
  const PointWorld::Flown flown = world.fly({});
  EXPECT_TRUE(flown.reached);
  EXPECT_LT(flown.fastest_mps, 2.0 * world.height_m + 0.01);
}

TEST(LocalMapFlight, FliesEightMetersPerSecondInOpenSpace) {
  PointWorld world;
  world.goal_W = {70.0, 0.0};
  world.height_m = 6.0;  // it flies slower near the ground
  LocalMapConfig config;
  config.noise_px = 0.1;  // depth is perfect here, and the camera too coarse for a long range with 0.5 px noise
  const PointWorld::Flown flown = world.fly(config);
  EXPECT_TRUE(flown.reached);
  EXPECT_GT(flown.fastest_mps, 7.5);
}

TEST(LocalMapFlight, LeavesADeadEnd) {
  PointWorld world;
  world.goal_W = {20.0, 0.0};
  world.walls = {{{9.0, -5.0}, {9.0, 5.0}}, {{2.0, -5.0}, {9.0, -5.0}}, {{2.0, 5.0}, {9.0, 5.0}}};
  const PointWorld::Flown flown = world.fly({});
  EXPECT_TRUE(flown.reached);
  EXPECT_GT(flown.clearance_m, 0.0);
}

// Walls leave less than the margin on both sides of the hull. Depth is perfect. The flight is slow and without contact.
TEST(LocalMapFlight, PassesAPassageTooNarrowForItsMargin) {
  constexpr double kHullM = 0.65, kVoxelM = 0.3;
  for (const double beside_m : {0.35, 0.45, 0.6}) {
    PointWorld world;
    world.radius_m = kHullM;
    world.goal_W = {16.0, 0.0};
    for (const double side : {-1.0, 1.0}) {
      const double wall_m = side * (kHullM + beside_m + 0.2);
      world.walls.push_back({{5.0, wall_m}, {11.0, wall_m}});
      world.walls.push_back({{5.0, wall_m}, {5.0, side * 40.0}});
    }
    const PointWorld::Flown flown = world.fly({});
    EXPECT_GT(flown.clearance_m, 0.0) << beside_m;
    // Half a voxel may be lost on either side.
    if (beside_m > kVoxelM + 0.05) {
      EXPECT_TRUE(flown.reached) << beside_m;
    }
  }
}

// Two walls leave a gap as the only way. The true distance decides whether the margin can be kept.
TEST(LocalMapFlight, ReportsExactlyTheMarginsThatItCannotKeep) {
  constexpr double kHullM = 0.65, kMarginM = 1.3, kMissM = 0.1;
  for (const auto& [beside_m, can_keep] : {std::pair{0.9, false}, {2.6, true}}) {
    PointWorld world;
    world.radius_m = kHullM;
    world.goal_W = {16.0, 0.0};
    for (const double side : {-1.0, 1.0})
      world.walls.push_back({{8.0, side * (kHullM + beside_m + 0.2)}, {8.0, side * 40.0}});
    double reported_share = 0.0, map_margin_m = 0.0;
    world.watch = [&](const auto&, double, const Decision&, const Module& module) {
      reported_share = 0.0;
      for (const Metric& metric : module.metrics()) {
        if (metric.name == "narrow_share" || metric.name == "close_share") reported_share += metric.value;
        if (metric.name == "map_margin") map_margin_m = metric.value;
      }
    };
    LocalMapConfig config;
    config.margin_m = kMarginM;
    const PointWorld::Flown flown = world.fly(config);
    const auto reports = std::ranges::count_if(
        flown.statuses, [](const std::string& status) { return status == "narrow" || status == "close"; });
    EXPECT_TRUE(flown.reached) << beside_m;
    EXPECT_EQ(flown.clearance_m >= kMarginM - kMissM, can_keep) << flown.clearance_m;
    EXPECT_EQ(reports == 0, can_keep) << reports;
    EXPECT_EQ(reported_share == 0.0, can_keep) << reported_share;
    EXPECT_EQ(map_margin_m >= kMarginM - kMissM, can_keep) << map_margin_m;
  }
}

// Obstacles that were unknown when the path was planned count as well. A report may be two decisions late.
TEST(LocalMapFlight, ReportsEveryViolationOfALargeMarginInRandomWorlds) {
  constexpr double kMarginM = 2.0, kMissM = 0.1;
  constexpr size_t kLate = 2;
  int violations = 0;
  for (uint64_t seed = 204; seed <= 206; ++seed) {
    PointWorld world = random_world(seed);
    world.radius_m = 0.65;
    LocalMapConfig config;
    config.margin_m = kMarginM;
    const PointWorld::Flown flown = world.fly(config);
    for (size_t i = 0; i + kLate < flown.track.size(); ++i) {
      if (world.distance_m(flown.track[i].p_W, 0.0) - world.radius_m >= kMarginM - kMissM) continue;
      ++violations;
      const auto status = flown.statuses.begin() + static_cast<std::ptrdiff_t>(i);
      EXPECT_TRUE(std::any_of(status, status + kLate + 1,
                              [](const std::string& name) { return name == "narrow" || name == "close"; }))
          << seed << ", " << flown.track[i].t_s;
    }
  }
  EXPECT_GT(violations, 10);  // of these worlds
}

TEST(LocalMapFlight, ReportsStuckIfNoRouteExists) {
  PointWorld world;
  world.goal_W = {20.0, 0.0};
  world.walls = {
      {{5.0, -5.0}, {5.0, 5.0}}, {{-5.0, -5.0}, {-5.0, 5.0}}, {{-5.0, -5.0}, {5.0, -5.0}}, {{-5.0, 5.0}, {5.0, 5.0}}};
  world.duration_s = 60.0;
  const PointWorld::Flown flown = world.fly({});
  EXPECT_FALSE(flown.reached);
  EXPECT_GT(flown.clearance_m, 0.0);
  EXPECT_GT(std::ranges::count(flown.statuses, "stuck"), 100);
}

}  // namespace
}  // namespace hedgehop::avoidance::local_map
