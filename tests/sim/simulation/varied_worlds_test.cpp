// The worlds of the papers' scenarios vary with the seed; start and goal must suit every one of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "scenes/scene.h"
#include "sim/libm/random.h"
#include "sim/scenario/flight_parts.h"
#include "sim/verdict/corridor_truth.h"

namespace hedgehop::sim {
namespace {

constexpr uint64_t kSeeds = 200;

Scenario configured(const std::string& name, std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.begin(), {"scene.texture_size=64", "drawing.renderer=tiles"});
  return load_scenario(std::string(HEDGEHOP_SOURCE_DIR) + "/configs/" + name + ".yaml", overrides);
}

// The leaderboard's worlds have no vehicle of their own.
std::vector<Scenario> corridors() {
  return {configured("zingg2010_corridor_2m5"),
          configured("zingg2010_corridor_4m"),
          configured("zingg2010_bend"),
          configured("zingg2010_doorway"),
          configured("zingg2010_narrowing"),
          configured("zingg2010_obstacle"),
          configured("leaderboard/worlds/corridor", {"vehicle={use: ../../vehicles/hummingbird.yaml}",
                                                     "avoidance={module: go_to_goal}", "velocimeter.enabled=false"})};
}

TEST(VariedWorlds, CorridorsHaveTheirGoalInTheMiddleAndTheirStartFree) {
  for (const Scenario& scenario : corridors()) {
    const std::string& name = scenario.name;
    const auto& corridor = std::get<scenes::worlds::CorridorConfig>(scenario.scene);
    const double hull_radius_m = dynamics::radius_m(dynamics::hull(scenario.vehicle));
    std::set<double> lengths_m;
    for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const auto plan = scenes::worlds::plan_corridor(corridor, stream_seed(seed, kSceneStream));
      const CorridorPlace goal = corridor_place(plan, scenario.goal->p_WG().head<2>());
      // The file gives the goal in centimeters, or, for the leaderboard, in decimeters.
      EXPECT_NEAR(goal.left_m, goal.right_m, 0.1) << name << ", seed " << seed;
      const Eigen::Vector2d end_NE = plan.middles_NE.back();
      EXPECT_GE((end_NE - scenario.goal->p_WG().head<2>()).norm(), scenario.goal->radius_m)
          << name << ", seed " << seed;
      for (int k = 0; k < 8; ++k) {
        const double bearing = 0.25 * k * std::numbers::pi, spread_m = scenario.start.spread_m;
        const Eigen::Vector2d start =
            scenario.start.p_WB().head<2>() + spread_m * Eigen::Vector2d(std::cos(bearing), std::sin(bearing));
        const CorridorPlace place = corridor_place(plan, start);
        EXPECT_GT(std::min({place.left_m, place.right_m, place.along_m}), hull_radius_m) << name << ", seed " << seed;
      }
      EXPECT_NO_THROW(scenes::worlds::draw_corridor(scenes::worlds::draw_corridor(corridor, seed), seed)) << name;
      lengths_m.insert((plan.middles_NE.back() - plan.middles_NE.front()).norm());
    }
    EXPECT_GT(lengths_m.size(), kSeeds / 2) << name;
  }
}

TEST(VariedWorlds, SkylinesLeaveStartAndGoalFreeAndStandAcrossTheRoute) {
  const Scenario scenario = configured("shah2009_avoid");
  const double hull_radius_m = dynamics::radius_m(dynamics::hull(scenario.vehicle));
  int across = 0;
  for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const scenes::Scene scene = build_scene(scenario.scene, seed);
    ASSERT_EQ(scene.corners_W.size(), 35u);
    bool is_hit = false;
    for (const scenes::Solid& solid : scene.solids) {
      const Eigen::AlignedBox3d box_W = bounds_W(solid);
      EXPECT_GT(box_W.exteriorDistance(scenario.start.p_WB()) - scenario.start.spread_m, hull_radius_m);
      EXPECT_GT(box_W.exteriorDistance(scenario.goal->p_WG()), hull_radius_m + scenario.goal->radius_m);
      is_hit = is_hit || std::max(box_W.min().y(), -box_W.max().y()) < hull_radius_m;
    }
    across += is_hit;
  }
  EXPECT_GE(across, 0.95 * kSeeds);
}

}  // namespace
}  // namespace hedgehop::sim
