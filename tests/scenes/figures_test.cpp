#include "scenes/figures.h"

#include <gtest/gtest.h>

#include <limits>

#include "scene_equality.h"
#include "scenes/generators.h"

namespace hedgehop::scenes {
namespace {

TEST(SceneFigures, SmallestGapIsThatOfAllPairs) {
  UrbanConfig config;
  config.texture_size_px = 64;
  for (uint64_t seed = 0; seed < 5; ++seed) {
    const Scene city = make_urban(config, seed);
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

TEST(SceneFigures, AnEmptyRoomIsAsWideAsItsWallsAreApart) {
  RoomConfig config;
  config.texture_size_px = 64;
  config.ceiling = false;
  const SceneFigures figures = scene_figures(make_room(config, 1));
  EXPECT_NEAR(figures.smallest_gap_m, 8.0, 1e-9);
  EXPECT_NEAR(figures.covered_share, 0.0, 1e-9);
}

TEST(SceneFigures, WithoutSolidsTheGapIsInfinite) {
  Scene empty;
  empty.bounds_NE_m = {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(1.0, 1.0)};
  EXPECT_EQ(scene_figures(empty).smallest_gap_m, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace hedgehop::scenes
