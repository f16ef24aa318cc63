#include "avoidance/local_map/hull_clearance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sim/libm/random.h"
#include "tests/avoidance/local_map/point_world.h"

namespace hedgehop::avoidance::local_map {
namespace {

/// A fuselage and a boom that extends far behind it.
std::vector<Eigen::AlignedBox3d> long_boom() {
  return {{Eigen::Vector3d(-0.45, -0.3, -0.2), Eigen::Vector3d(0.45, 0.3, 0.2)},
          {Eigen::Vector3d(-1.8, -0.05, -0.05), Eigen::Vector3d(0.0, 0.05, 0.05)}};
}
const double kBoomRadiusM = std::hypot(1.8, 0.05);

bool holds(const std::vector<HullDiscs::Disc>& discs, const Eigen::Vector2d& p) {
  constexpr double kRoundM = 1e-9;
  return std::ranges::any_of(discs, [&](const auto& disc) { return (p - disc.p_H).norm() <= disc.radius_m + kRoundM; });
}

TEST(HullDiscs, ContainEveryPointOfRandomBoxes) {
  std::mt19937_64 random(1);
  const auto uniform = [&](double low, double high) { return hedgehop::uniform(random, low, high); };
  for (int i = 0; i < 200; ++i) {
    VehicleLimits limits{8.0, 3.0, 0.0, {}};
    for (int box = 0; box < 3; ++box) {
      const Eigen::Vector3d middle(uniform(-1.0, 1.0), uniform(-0.5, 0.5), 0.0);
      const Eigen::Vector3d half(uniform(0.05, 1.0), uniform(0.05, 0.5), 0.1);
      limits.outline_B.emplace_back(middle - half, middle + half);
      limits.radius_m = std::max(limits.radius_m, (middle.cwiseAbs() + half).head<2>().norm());
    }
    const HullDiscs hull_discs(limits);
    for (const Eigen::AlignedBox3d& box : limits.outline_B) {
      for (int point = 0; point < 100; ++point) {
        const Eigen::Vector2d at(uniform(0.0, 1.0), uniform(0.0, 1.0));
        ASSERT_TRUE(holds(hull_discs.discs(), box.min().head<2>() + at.cwiseProduct(box.sizes().head<2>()))) << i;
      }
    }
  }
}

TEST(HullDiscs, CoverABoomWithItsOwnWidth) {
  const HullDiscs hull_discs({8.0, 3.0, kBoomRadiusM, long_boom()});
  EXPECT_TRUE(holds(hull_discs.discs(), {-1.8, 0.0}));
  EXPECT_FALSE(holds(hull_discs.discs(), {-1.5, 0.3}));
  EXPECT_FALSE(holds(hull_discs.discs(), {1.0, 0.0}));
}

TEST(HullDiscs, CoverARotorWithTheDiscInsideItsBox) {
  // Its corners are outside the cylinder that contains the vehicle.
  const HullDiscs hull_discs({8.0,
                              3.0,
                              1.2,
                              {{Eigen::Vector3d(-0.9, -0.9, -0.3), Eigen::Vector3d(0.9, 0.9, -0.25)},
                               {Eigen::Vector3d(-1.19, -0.05, -0.05), Eigen::Vector3d(0.0, 0.05, 0.05)}}});
  EXPECT_TRUE(holds(hull_discs.discs(), {0.0, 0.9}));
  EXPECT_FALSE(holds(hull_discs.discs(), {0.7, 0.7}));
}

TEST(HullDiscs, CoverAMulticopterWithOneDisc) {
  EXPECT_EQ(HullDiscs({8.0, 3.0, 0.65, {}}).discs().size(), 1u);
  EXPECT_EQ(HullDiscs({8.0, 3.0, 0.5, {{Eigen::Vector3d(-0.35, -0.35, -0.1), Eigen::Vector3d(0.35, 0.35, 0.1)}}})
                .discs()
                .size(),
            1u);
}

// The vehicle hovers with its nose at a wall, nearer than the length of its boom, accelerates slowly and has to turn.
TEST(HullDiscs, LongBoomDoesNotHitAWallDuringATurnNextToIt) {
  for (const double away_m : {0.9, 1.1}) {
    PointWorld world;
    world.walls = {{{-8.0, away_m + 0.2}, {8.0, away_m + 0.2}, 0.4}};
    world.goal_W = {0.0, -20.0};
    world.heading_rad = 0.5 * M_PI;
    world.radius_m = kBoomRadiusM;
    world.outline_B = long_boom();
    world.speed_mps = 0.15;
    world.duration_s = 40.0;
    const PointWorld::Flown flown = world.fly({});
    EXPECT_GT(flown.clearance_m, 0.0) << away_m;
    // After the turn it observes its surroundings; the test requires only the completed turn.
    EXPECT_TRUE(std::ranges::any_of(flown.track, [](const auto& state) {
      return std::abs(std::remainder(state.heading_rad + 0.5 * M_PI, 2.0 * M_PI)) < 0.1;
    })) << away_m;
  }
}

// Two positions in one cell, 0.1 and 0.4 m from the adjacent obstacle. A look-up does not distinguish them.
TEST(HullClearance, KeepsASmallMarginWithSubCellAccuracy) {
  constexpr double kCellM = 0.5, kHullM = 0.3;
  vision::mapping::OccupancyMap map({.voxel_m = kCellM, .across = 20, .layers = 1});
  map.reset(Eigen::Vector3d::Zero());
  ClosedCells closed(kCellM);
  closed.remember({0.25, 0.25, 0.1}, 0.0);  // [0, 0.5] m north and east
  LevelSlice slice;
  slice.build(map, {0.1, 0.4}, closed);
  const auto lacks_m = [&](double margin_m, double north_m) {
    HullClearance hull_clearance(HullDiscs({8.0, 3.0, kHullM, {}}), {kHullM, margin_m, 0.0}, kCellM);
    hull_clearance.set_turn(0.0, 0.0);
    return hull_clearance.deficit(slice, {0.0, {north_m, 0.25}, Eigen::Vector2d::Zero()}, false).occupied_m;
  };
  EXPECT_NEAR(lacks_m(0.05, 0.6), kHullM + 0.05 - 0.1, 1e-9);
  EXPECT_EQ(lacks_m(0.05, 0.9), 0.0);
  EXPECT_EQ(lacks_m(0.3, 0.6), lacks_m(0.3, 0.9));
}

// Known space is a disc of 6 m. The vehicle is at its center, or 4 m north of it.
TEST(HullClearance, KeepsAMarginFromUnknownSpaceBeyondTheViewOrTheCurrentDistance) {
  constexpr double kCellM = 0.1, kHullM = 0.3, kMarginM = 2.0, kHalfViewRad = 0.7, kKnownM = 6.0;
  constexpr double kLookUp = 1.5 * kCellM;  // cells at the edge of the disc, and a look-up from the center of a cell
  vision::mapping::OccupancyMap map({.voxel_m = kCellM, .across = 160, .layers = 1});
  map.reset(Eigen::Vector3d::Zero());
  map.clear_cylinder(Eigen::Vector3d(0.0, 0.0, 0.05), kKnownM, 1.0);
  LevelSlice slice;
  slice.build(map, {0.04, 0.06}, ClosedCells(kCellM));
  HullClearance hull_clearance(HullDiscs({8.0, 3.0, kHullM, {}}), {kHullM, 0.0, 0.0}, kCellM);
  hull_clearance.set_turn(0.0, 0.0);
  const auto lacks_m = [&](double north_m) {
    return hull_clearance.deficit(slice, {0.0, {north_m, 0.0}, Eigen::Vector2d::Zero()}, true).unknown_m;
  };
  EXPECT_EQ(lacks_m(5.0), 0.0);
  hull_clearance.keep_from_unknown(slice, {0.0, 0.0}, kMarginM, kHalfViewRad);
  EXPECT_EQ(lacks_m(3.0), 0.0);
  EXPECT_NEAR(lacks_m(5.0), kHullM + kMarginM - 1.0, kLookUp);
  hull_clearance.keep_from_unknown(slice, {4.0, 0.0}, kMarginM, kHalfViewRad);  // 1.7 m from its hull
  EXPECT_EQ(lacks_m(4.0), 0.0);
  EXPECT_NEAR(lacks_m(5.0), 1.0, kLookUp);                       // nearer than the view is wide
  EXPECT_NEAR(lacks_m(-5.0), kHullM + kMarginM - 1.0, kLookUp);  // farther
  hull_clearance.keep_from_unknown(slice, {4.0, 0.0}, 0.0, kHalfViewRad);
  EXPECT_EQ(lacks_m(5.0), 0.0);
}

}  // namespace
}  // namespace hedgehop::avoidance::local_map
