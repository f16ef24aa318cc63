#include "avoidance/local_map/outline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sim/libm/random.h"
#include "tests/avoidance/local_map/point_world.h"

namespace hedgehop::avoidance::local_map {
namespace {

/// A fuselage and a boom that reaches far behind it.
std::vector<Eigen::AlignedBox3d> long_boom() {
  return {{Eigen::Vector3d(-0.45, -0.3, -0.2), Eigen::Vector3d(0.45, 0.3, 0.2)},
          {Eigen::Vector3d(-1.8, -0.05, -0.05), Eigen::Vector3d(0.0, 0.05, 0.05)}};
}
const double kBoomRadiusM = std::hypot(1.8, 0.05);

bool holds(const std::vector<Outline::Disc>& discs, const Eigen::Vector2d& p) {
  constexpr double kRoundM = 1e-9;
  return std::ranges::any_of(discs, [&](const auto& disc) { return (p - disc.p_H).norm() <= disc.radius_m + kRoundM; });
}

TEST(Outline, HoldsEveryPointOfRandomBoxes) {
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
    const Outline outline(limits);
    for (const Eigen::AlignedBox3d& box : limits.outline_B) {
      for (int point = 0; point < 100; ++point) {
        const Eigen::Vector2d at(uniform(0.0, 1.0), uniform(0.0, 1.0));
        ASSERT_TRUE(holds(outline.discs(), box.min().head<2>() + at.cwiseProduct(box.sizes().head<2>()))) << i;
      }
    }
  }
}

TEST(Outline, ABoomTakesUpNoMoreThanItsOwnWidth) {
  const Outline outline({8.0, 3.0, kBoomRadiusM, long_boom()});
  EXPECT_TRUE(holds(outline.discs(), {-1.8, 0.0}));
  EXPECT_FALSE(holds(outline.discs(), {-1.5, 0.3}));
  EXPECT_FALSE(holds(outline.discs(), {1.0, 0.0}));
}

TEST(Outline, ARotorIsTheDiscInItsBox) {
  // Its corners lie beyond the cylinder that holds the vehicle.
  const Outline outline({8.0,
                         3.0,
                         1.2,
                         {{Eigen::Vector3d(-0.9, -0.9, -0.3), Eigen::Vector3d(0.9, 0.9, -0.25)},
                          {Eigen::Vector3d(-1.19, -0.05, -0.05), Eigen::Vector3d(0.0, 0.05, 0.05)}}});
  EXPECT_TRUE(holds(outline.discs(), {0.0, 0.9}));
  EXPECT_FALSE(holds(outline.discs(), {0.7, 0.7}));
}

TEST(Outline, OfAMulticopterIsOneDisc) {
  EXPECT_EQ(Outline({8.0, 3.0, 0.65, {}}).discs().size(), 1u);
  EXPECT_EQ(Outline({8.0, 3.0, 0.5, {{Eigen::Vector3d(-0.35, -0.35, -0.1), Eigen::Vector3d(0.35, 0.35, 0.1)}}})
                .discs()
                .size(),
            1u);
}

// It stands with its nose at a wall, nearer than its boom is long, is slow to get away, and has to turn round.
TEST(Outline, ALongBoomDoesNotSwingIntoTheWallThatItTurnsBeside) {
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
    // Once turned it looks about: what counts is that it got round.
    EXPECT_TRUE(std::ranges::any_of(flown.track, [](const auto& moment) {
      return std::abs(std::remainder(moment.heading_rad + 0.5 * M_PI, 2.0 * M_PI)) < 0.1;
    })) << away_m;
  }
}

}  // namespace
}  // namespace hedgehop::avoidance::local_map
