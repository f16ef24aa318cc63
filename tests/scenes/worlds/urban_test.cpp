#include "scenes/worlds/urban.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "scenes/generators.h"
#include "scenes/worlds/wear.h"
#include "tests/scenes/scene_equality.h"

namespace hedgehop::scenes::worlds {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

UrbanConfig city_with_small_images() {
  UrbanConfig config;
  config.texture_size_px = 64;
  return config;
}

// Returns the gap between the outlines of two boxes in the plan, computed per axis.
double plan_gap(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b) {
  const double north = std::max({a.min().x() - b.max().x(), b.min().x() - a.max().x(), 0.0});
  const double east = std::max({a.min().y() - b.max().y(), b.min().y() - a.max().y(), 0.0});
  return std::hypot(north, east);
}

double distance_to_plan(const Eigen::AlignedBox3d& box, double north, double east) {
  const double dn = std::max({box.min().x() - north, north - box.max().x(), 0.0});
  const double de = std::max({box.min().y() - east, east - box.max().y(), 0.0});
  return std::hypot(dn, de);
}

TEST(Urban, SameSeedGivesTheSameSceneBitForBit) {
  const SceneConfig config = city_with_small_images();
  EXPECT_TRUE(identical(make_scene(config, 7), make_scene(config, 7)));
}

TEST(Urban, AnotherSeedGivesAnotherCityAndOtherTextures) {
  const Scene a = make_scene(city_with_small_images(), 7), b = make_scene(city_with_small_images(), 8);
  EXPECT_FALSE(identical(a, b));
  EXPECT_GT(cv::norm(a.textures.images().back(), b.textures.images().back(), cv::NORM_L1), 0.0);
  EXPECT_NE(a.solids.front().half_extents_m, b.solids.front().half_extents_m);
}

TEST(Urban, AWornStreetOfAnyWidthIsDrawnOnce) {
  constexpr double kLengthM = 20.0, kInsetM = 1.9, kFloatM2 = 1e-3;
  for (const double width_m : {1.0, 2.5, 3.7, 3.8, 3.9, 8.0}) {
    Wear wear{.surfaces = {0, 1}, .repairs = 2, .random = Random(3)};
    mesh::MeshBuilder builder("opaque");
    builder.begin_instance("road", SemanticClass::road);
    builder.begin_chunk(false);
    add_worn({{0.0, 0.0, 0.0}, {0.0, width_m, 0.0}, {-kLengthM, 0.0, 0.0}}, {}, kInsetM, wear, builder);
    const Mesh mesh = builder.finish();
    double area_m2 = 0.0;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
      const Eigen::Vector3f &a = mesh.vertices[mesh.indices[i]].p_W, &b = mesh.vertices[mesh.indices[i + 1]].p_W,
                            &c = mesh.vertices[mesh.indices[i + 2]].p_W;
      area_m2 += 0.5 * static_cast<double>((b - a).cross(c - a).norm());
    }
    EXPECT_NEAR(area_m2, width_m * kLengthM, kFloatM2) << width_m;
  }
}

TEST(Urban, BuildingsAreAtLeastTheMinimumStreetWidthApart) {
  for (uint64_t seed = 0; seed < 100; ++seed) {
    UrbanConfig config;
    config.street_min_width_m = 6.0 + 0.07 * static_cast<double>(seed);
    const UrbanPlan plan = plan_urban(config, seed);
    for (size_t i = 0; i < plan.buildings.size(); ++i) {
      for (size_t j = i + 1; j < plan.buildings.size(); ++j) {
        ASSERT_GE(plan_gap(plan.buildings[i].boxes_W[0], plan.buildings[j].boxes_W[0]),
                  config.street_min_width_m - 1e-9);
      }
    }
  }
}

TEST(Urban, DefaultStreetsAreAtLeastEightMetersWide) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const UrbanPlan plan = plan_urban(UrbanConfig{}, seed);
    ASSERT_GT(plan.buildings.size(), 1u);
    for (size_t i = 0; i < plan.buildings.size(); ++i) {
      for (size_t j = i + 1; j < plan.buildings.size(); ++j)
        ASSERT_GE(plan_gap(plan.buildings[i].boxes_W[0], plan.buildings[j].boxes_W[0]), 8.0 - 1e-9) << seed;
    }
  }
}

TEST(Urban, ClearingsAreFreeForEverySeed) {
  const UrbanConfig config;
  ASSERT_EQ(config.keep_clear.size(), 2u);
  for (uint64_t seed = 0; seed < 200; ++seed) {
    for (const Building& building : plan_urban(config, seed).buildings) {
      for (const Eigen::AlignedBox3d& box : building.boxes_W) {
        ASSERT_GE(distance_to_plan(box, -130.0, 80.0), 6.0) << "seed " << seed;
        ASSERT_GE(distance_to_plan(box, 110.0, -110.0), 6.0) << "seed " << seed;
      }
    }
  }
}

TEST(Urban, ClearingsAreFreeAndHaveBuildingsCloseBy) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> place(-140.0, 140.0), radius(0.5, 8.0);
  double tightest = 1e9;
  for (uint64_t seed = 0; seed < 50; ++seed) {
    UrbanConfig config;
    config.keep_clear.clear();
    for (int k = 0; k < 40; ++k) config.keep_clear.push_back({place(random), place(random), radius(random)});
    const UrbanPlan plan = plan_urban(config, seed);
    EXPECT_GT(plan.buildings.size(), 60u);
    for (const Building& building : plan.buildings) {
      for (const Clearing& c : config.keep_clear) {
        const double spare = distance_to_plan(building.boxes_W[0], c.north_m, c.east_m) - c.radius_m;
        ASSERT_GE(spare, 0.0) << "seed " << seed;
        tightest = std::min(tightest, spare);
      }
    }
  }
  EXPECT_LT(tightest, 0.02);
}

TEST(Urban, AClearingOverTheWholeCityLeavesNoBuilding) {
  UrbanConfig config;
  config.keep_clear = {{0.0, 0.0, 300.0}};
  EXPECT_TRUE(plan_urban(config, 1).buildings.empty());
}

TEST(Urban, AllCellsOutsideClearingsHaveABuilding) {
  for (uint64_t seed = 0; seed < 50; ++seed) {
    const size_t count = plan_urban(UrbanConfig{}, seed).buildings.size();
    EXPECT_GE(count, 98u);
    EXPECT_LE(count, 100u);
  }
}

TEST(Urban, BuildingsAreOnTheGroundAndRoofsWithinTheHeights) {
  const UrbanConfig config;
  double lowest = 1e9, highest = 0.0;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    for (const Building& building : plan_urban(config, seed).buildings) {
      ASSERT_EQ(building.boxes_W[0].max().z(), 0.0);
      for (size_t k = 0; k < building.boxes_W.size(); ++k) {
        const double height = -building.boxes_W[k].min().z();
        ASSERT_GE(height, config.min_height_m);
        ASSERT_LE(height, config.max_height_m);
        if (k > 0) {  // is on top of the box below, within its footprint
          const Eigen::AlignedBox3d &below = building.boxes_W[k - 1], &box = building.boxes_W[k];
          ASSERT_EQ(box.max().z(), below.min().z());
          ASSERT_TRUE((box.min().head<2>().array() >= below.min().head<2>().array()).all());
          ASSERT_TRUE((box.max().head<2>().array() <= below.max().head<2>().array()).all());
        }
        ASSERT_GT(building.boxes_W[k].sizes().minCoeff(), 1.0);
      }
      lowest = std::min(lowest, -building.boxes_W.back().min().z());
      highest = std::max(highest, -building.boxes_W.back().min().z());
    }
  }
  EXPECT_LT(lowest, 18.0);
  EXPECT_GT(highest, 38.0);
}

TEST(Urban, TenThousandBuildingsAreAsDenseAsAHundred) {
  UrbanConfig small, large;
  small.keep_clear.clear();
  large.keep_clear.clear();
  large.extent_m = 3000.0;
  const auto built_share = [](const UrbanConfig& config) {
    double area_m2 = 0.0;
    for (const Building& building : plan_urban(config, 3).buildings) {
      area_m2 += building.boxes_W[0].sizes().x() * building.boxes_W[0].sizes().y();
    }
    return area_m2 / (config.extent_m * config.extent_m);
  };
  EXPECT_EQ(plan_urban(small, 3).buildings.size(), 100u);
  EXPECT_EQ(plan_urban(large, 3).buildings.size(), 10000u);
  // Mean side of a lot of 22 m times (0.55 + 1) / 2: 17.05 m, in a cell of 30 m.
  const double expected = 17.05 * 17.05 / 900.0;
  EXPECT_NEAR(built_share(large), expected, 0.01);
  EXPECT_NEAR(built_share(small), expected, 0.06);
}

TEST(Urban, RejectsInvalidConfigs) {
  const auto refused = [](auto change) {
    UrbanConfig config = city_with_small_images();
    change(config);
    return [config] { make_urban(config, 1); };
  };
  EXPECT_THAT(refused([](auto& c) { c.pitch_m = 9.0; }),
              ThrowsMessage<std::invalid_argument>(HasSubstr("pitch: 9; valid: ")));
  EXPECT_THAT(refused([](auto& c) { c.extent_m = 20.0; }),
              ThrowsMessage<std::invalid_argument>(HasSubstr("extent: 20")));
  EXPECT_THAT(refused([](auto& c) { c.extent_m = std::nan(""); }),
              ThrowsMessage<std::invalid_argument>(HasSubstr("extent")));
  EXPECT_THAT(refused([](auto& c) { c.max_height_m = 10.0; }),
              ThrowsMessage<std::invalid_argument>(HasSubstr("max_height: 10")));
  EXPECT_THAT(refused([](auto& c) { c.min_footprint = 0.0; }),
              ThrowsMessage<std::invalid_argument>(HasSubstr("min_footprint")));
  EXPECT_THAT(refused([](auto& c) { c.max_footprint = 0.5; }),
              ThrowsMessage<std::invalid_argument>(HasSubstr("footprint")));
  EXPECT_THAT(refused([](auto& c) { c.jitter = 1.5; }),
              ThrowsMessage<std::invalid_argument>(HasSubstr("jitter: must be <= 1, got 1.5")));
  EXPECT_THAT(refused([](auto& c) { c.keep_clear[0].radius_m = -1.0; }),
              ThrowsMessage<std::invalid_argument>(HasSubstr("radius: must be >= 0 m, got -1")));
  EXPECT_THAT(refused([](auto& c) { c.texture_size_px = 500; }),
              ThrowsMessage<std::invalid_argument>(HasSubstr("texture_size: 500")));
}

}  // namespace
}  // namespace hedgehop::scenes::worlds
