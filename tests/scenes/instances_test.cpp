// The objects of a scene: one instance each, with the names that results use.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "scenes/generators.h"

namespace hedgehop::scenes {
namespace {

std::vector<Scene> every_world() {
  constexpr int64_t kTexturePx = 64;
  const std::vector<SceneConfig> configs = {
      worlds::UrbanConfig{.extent_m = 150.0, .setback_share = 0.8, .keep_clear = {}, .texture_size_px = kTexturePx},
      worlds::RoomConfig{.furniture = 4, .texture_size_px = kTexturePx},
      worlds::RoomConfig{.ceiling = false, .texture_size_px = kTexturePx},
      worlds::TreeConfig{.texture_size_px = kTexturePx},
      worlds::ForestConfig{.trees = 1500, .texture_size_px = kTexturePx},
      worlds::CorridorConfig{.sections = {{10.0, 0.0, 0.0, 1.2, 0.0}, {10.0, 0.5, 0.0, 0.0, 0.7}},
                             .texture_size_px = kTexturePx},
      worlds::HighriseConfig{.texture_size_px = kTexturePx},
      worlds::BalloonConfig{.texture_size_px = kTexturePx},
      worlds::WallConfig{.opening = worlds::WallOpening{}, .texture_size_px = kTexturePx},
      worlds::ParkConfig{.texture_size_px = kTexturePx}};
  std::vector<Scene> scenes;
  for (const SceneConfig& config : configs) scenes.push_back(make_scene(config, 3));
  return scenes;
}

bool is_ground(const Instance& instance) {
  return instance.kind == SemanticClass::ground || instance.kind == SemanticClass::road;
}

TEST(Instances, HaveTheNamesOfTheSolids) {
  for (const Scene& scene : every_world()) {
    std::set<std::string> names, of_solids;
    for (const Instance& instance : instances(scene)) {
      EXPECT_NE(instance.kind, SemanticClass::other) << instance.name;
      if (!is_ground(instance)) names.insert(instance.name);
    }
    for (size_t i = 0; i < solid_count(scene); ++i) of_solids.insert(solid_at(scene, i).name);
    EXPECT_EQ(names, of_solids) << scene.name;
  }
}

// Also of buildings with several boxes, and of trees that share a chunk.
TEST(Instances, LieWithinTheSolidsOfTheirName) {
  constexpr double kFloatM = 1e-3;
  for (const Scene& scene : every_world()) {
    std::map<std::string, std::vector<Eigen::AlignedBox3d>> boxes_W;
    for (const Solid& solid : scene.solids) boxes_W[solid.name].push_back(bounds_W(solid));
    for (const Mesh& mesh : scene.meshes) {
      for (const Vertex& vertex : mesh.vertices) {
        const Instance& instance = mesh.instances.at(vertex.instance);
        if (is_ground(instance)) continue;
        double distance_m = std::numeric_limits<double>::infinity();
        for (const Eigen::AlignedBox3d& box_W : boxes_W.at(instance.name)) {
          distance_m = std::min(distance_m, box_W.exteriorDistance(vertex.p_W.cast<double>()));
        }
        ASSERT_LT(distance_m, kFloatM) << scene.name << ": " << instance.name;
      }
    }
  }
}

TEST(Instances, AreTheGroundOrTheRoadForLevelFacesAtHeightZero) {
  for (const Scene& scene : every_world()) {
    const std::vector<Instance> all = instances(scene);
    EXPECT_EQ(std::ranges::count(all, SemanticClass::ground, &Instance::kind), 1) << scene.name;
    EXPECT_LE(std::ranges::count(all, SemanticClass::road, &Instance::kind), 1) << scene.name;
    for (const Mesh& mesh : scene.meshes) {
      for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto corner = [&](size_t k) -> const Vertex& { return mesh.vertices[mesh.indices[i + k]]; };
        ASSERT_EQ(corner(0).instance, corner(1).instance);
        ASSERT_EQ(corner(0).instance, corner(2).instance);
        const bool level = corner(0).p_W.z() == 0.0f && corner(1).p_W.z() == 0.0f && corner(2).p_W.z() == 0.0f;
        ASSERT_EQ(is_ground(mesh.instances.at(corner(0).instance)), level) << scene.name;
      }
    }
  }
}

TEST(Instances, OfMoversAreTheLast) {
  worlds::WallConfig config{.texture_size_px = 64};
  config.added.boxes = {{.name = "shed"}, {.name = "shed"}};
  config.added.movers = {{.name = "ball"}, {.name = "oak", .shape = MoverConfig::Shape::tree}};
  const Scene scene = make_scene(config, 1);
  std::vector<std::string> names;
  for (const Instance& instance : instances(scene)) names.push_back(instance.name);
  EXPECT_THAT(names, testing::ElementsAre("ground", "wall", "shed", "shed", "ball", "oak"));
  EXPECT_EQ(first_mover_label(scene), 5);
  EXPECT_EQ(instances(scene).back().kind, SemanticClass::tree);
}

}  // namespace
}  // namespace hedgehop::scenes
