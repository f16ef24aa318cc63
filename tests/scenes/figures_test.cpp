#include "scenes/figures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <random>

#include "scene_equality.h"
#include "scenes/generators.h"
#include "scenes/mesh/bodies.h"

namespace hedgehop::scenes {
namespace {

TEST(SceneFigures, MinimumGapEqualsThatOverAllPairs) {
  worlds::UrbanConfig config;
  config.texture_size_px = 64;
  for (uint64_t seed = 0; seed < 5; ++seed) {
    const Scene city = worlds::make_urban(config, seed);
    double smallest = std::numeric_limits<double>::infinity();
    for (const Solid& a : city.solids) {
      for (const Solid& b : city.solids) {
        const Eigen::Vector2d apart =
            ((a.X_WS.translation() - b.X_WS.translation()).cwiseAbs() - a.half_extents_m - b.half_extents_m)
                .head<2>()
                .cwiseMax(0.0);
        if (apart.norm() > 1e-6) smallest = std::min(smallest, apart.norm());
      }
    }
    EXPECT_NEAR(scene_figures(city).smallest_gap_m, smallest, 1e-9);
    EXPECT_EQ(scene_figures(city).solids, city.solids.size());
  }
}

TEST(SceneFigures, GapOfAnEmptyRoomIsItsWidth) {
  worlds::RoomConfig config;
  config.texture_size_px = 64;
  config.ceiling = false;
  const SceneFigures figures = scene_figures(worlds::make_room(config, 1));
  EXPECT_NEAR(figures.smallest_gap_m, 8.0, 1e-9);
  EXPECT_NEAR(figures.covered_share, 0.0, 1e-9);
}

// Posts of radius r on a square grid of pitch s: gaps of s - 2 r, one post to s^2, pi r^2 of it covered.
TEST(SceneFigures, OfAGridOfPostsFollowPitchAndRadius) {
  const double pitch_m = 4.0, radius_m = 0.3;
  Scene grid;
  grid.bounds_NE_m = {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(10 * pitch_m, 10 * pitch_m)};
  for (int k = 0; k < 100; ++k) {
    const mesh::Post post{{pitch_m * (k % 10 + 0.5), pitch_m * (k / 10 + 0.5), 0.0}, radius_m, 5.0};
    grid.solids.push_back(mesh::solid_of("post", post));
  }
  const SceneFigures figures = scene_figures(grid);
  EXPECT_EQ(figures.solids, 100u);
  EXPECT_NEAR(figures.smallest_gap_m, pitch_m - 2.0 * radius_m, 1e-9);
  EXPECT_NEAR(figures.median_gap_m, pitch_m - 2.0 * radius_m, 1e-9);
  EXPECT_NEAR(figures.density_pm2, 1.0 / (pitch_m * pitch_m), 1e-12);
  EXPECT_NEAR(figures.covered_share, std::numbers::pi * radius_m * radius_m / (pitch_m * pitch_m), 1e-12);
  EXPECT_EQ(scene_figures(grid, {.lowest_m = 5.1, .highest_m = 9.0}).solids, 0u);
  EXPECT_EQ(scene_figures(grid, {.lowest_m = 4.9, .highest_m = 9.0}).solids, 100u);
}

TEST(SceneFigures, MedianGapEqualsThatOverAllPairs) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 20; ++trial) {
    Scene scene;
    scene.bounds_NE_m = {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(50.0, 50.0)};
    for (int k = 0; k < 41; ++k) {
      scene.solids.push_back(mesh::ball_of("ball", {uniform(random, 0.0, 50.0), uniform(random, 0.0, 50.0), -3.0},
                                           uniform(random, 0.1, 3.0)));
    }
    std::vector<double> gaps;
    for (const Solid& a : scene.solids) {
      double least = std::numeric_limits<double>::infinity();
      for (const Solid& b : scene.solids) {
        const double gap =
            (a.X_WS.translation() - b.X_WS.translation()).norm() - a.half_extents_m.x() - b.half_extents_m.x();
        if (gap > 1e-6) least = std::min(least, gap);
      }
      gaps.push_back(least);
    }
    std::sort(gaps.begin(), gaps.end());
    EXPECT_NEAR(scene_figures(scene).median_gap_m, gaps[20], 1e-9);
    EXPECT_NEAR(scene_figures(scene).smallest_gap_m, gaps[0], 1e-9);
  }
}

TEST(SceneFigures, WithoutSolidsTheGapIsInfinite) {
  Scene empty;
  empty.bounds_NE_m = {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(1.0, 1.0)};
  EXPECT_EQ(scene_figures(empty).smallest_gap_m, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace hedgehop::scenes
