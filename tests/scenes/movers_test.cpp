#include "scenes/additions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene_equality.h"
#include "scenes/generators.h"

namespace hedgehop::scenes {
namespace {

using Shape = MoverConfig::Shape;

worlds::RoomConfig room_with(std::vector<MoverConfig> movers) {
  worlds::RoomConfig config;
  config.texture_size_px = 64;
  config.added.movers = std::move(movers);
  return config;
}

std::vector<MoverConfig> one_of_each() {
  std::vector<MoverConfig> movers;
  for (const Shape shape : {Shape::balloon, Shape::pole, Shape::box, Shape::tree}) movers.push_back({.shape = shape});
  return movers;
}

Eigen::AlignedBox3d bounds_M(const Mover& mover) {
  Eigen::AlignedBox3d box;
  for (const Vertex& vertex : mover.mesh.vertices) box.extend(vertex.p_W.cast<double>());
  return box;
}

TEST(Movers, HaveTheirConfiguredSizeAboveTheirFoot) {
  for (const Shape shape : {Shape::balloon, Shape::pole, Shape::box, Shape::tree}) {
    const MoverConfig config{.shape = shape, .radius_m = 0.8, .height_m = 5.0};
    const Scene room = make_scene(room_with({config}), 1);
    const Eigen::AlignedBox3d box = bounds_M(room.movers.at(0));
    EXPECT_NEAR(box.max().z(), 0.0, 1e-6);
    const double top_m = shape == Shape::balloon ? 5.8 : 5.0;
    EXPECT_LE(-box.min().z(), top_m + 1e-6);
    EXPECT_GE(-box.min().z(), 0.94 * top_m);  // a crown's lumps are rough
    EXPECT_LE(0.5 * box.sizes().head<2>().maxCoeff(), 0.8 + 1e-6);
    EXPECT_GE(0.5 * box.sizes().head<2>().minCoeff(), 0.8 * 0.8);
  }
}

TEST(Movers, HaveMeshesThatAgreeWithTheirSolids) {
  const Scene room = make_scene(room_with(one_of_each()), 1);
  for (const Mover& mover : room.movers) {
    Eigen::AlignedBox3d hit;
    for (const Solid& solid : mover.solids) hit.extend(bounds_W(solid));
    const Eigen::AlignedBox3d seen = bounds_M(mover);
    EXPECT_LT((hit.min() - seen.min()).cwiseAbs().maxCoeff(), 0.02);
    EXPECT_LT((hit.max() - seen.max()).cwiseAbs().maxCoeff(), 0.02);
  }
}

TEST(Movers, DoNotChangeTheRestOfTheScene) {
  Scene with = make_scene(room_with(one_of_each()), 3);
  const Scene without = make_scene(room_with({}), 3);
  EXPECT_TRUE(identical(make_scene(room_with(one_of_each()), 3), with));
  std::vector<cv::Mat> images = with.textures.images();
  images.resize(without.textures.size());
  with.textures = std::move(images);
  with.movers.clear();
  EXPECT_TRUE(identical(with, without));
}

TEST(SceneEquality, SeesEveryDifference) {
  const Scene scene = make_scene(room_with(one_of_each()), 3);
  const std::vector<void (*)(Scene&)> changes{
      [](Scene& s) { s.lights.sun += 0.1f; },
      [](Scene& s) { s.sky.visibility_m = 1e3; },
      [](Scene& s) { s.has_ground = !s.has_ground; },
      [](Scene& s) { s.corners_W.emplace_back(0.0, 0.0, 0.0); },
      [](Scene& s) { s.shortest_edge_m = 0.5; },
      [](Scene& s) { s.bounds_NE_m.extend(Eigen::Vector2d(1e3, 0.0)); },
      [](Scene& s) { s.meshes.at(0).instances.at(0).name += "2"; },
      [](Scene& s) { s.meshes.at(0).chunks.at(0).box_W.extend(Eigen::Vector3f(0.0f, 0.0f, -1e3f)); },
      [](Scene& s) { s.meshes.at(0).chunks.at(0).core_W.extend(Eigen::Vector3f(0.0f, 0.0f, -1e3f)); },
      [](Scene& s) { s.meshes.at(0).chunks.at(0).first_index += 3; },
      [](Scene& s) { s.meshes.at(0).chunks.at(0).fills_box_to_ground ^= true; },
      [](Scene& s) { s.meshes.at(0).chunks.at(0).far.lost_m += 1.0f; },
      [](Scene& s) { s.movers.at(0).name += "2"; },
      [](Scene& s) { s.movers.at(0).motion = OrbitMotion(); },
      [](Scene& s) { std::get<WaypointMotion>(s.movers.at(0).motion).speed_mps += 1.0; }};
  for (size_t k = 0; k < changes.size(); ++k) {
    Scene changed = scene;
    EXPECT_TRUE(identical(changed, scene));
    changes[k](changed);
    EXPECT_FALSE(identical(changed, scene)) << "change " << k;
  }
}

TEST(Movers, FollowTheScenesSolidsInTheCount) {
  const Scene room = make_scene(room_with(one_of_each()), 1);
  EXPECT_EQ(solid_at(room, 0).name, "north wall");
  EXPECT_EQ(&solid_at(room, room.solids.size()), &room.movers[0].solids[0]);
  EXPECT_EQ(&solid_at(room, solid_count(room) - 1), &room.movers[3].solids.back());
  EXPECT_THROW(solid_at(room, solid_count(room)), std::out_of_range);
}

TEST(Movers, RejectInvalidConfigs) {
  using E = std::invalid_argument;
  using testing::HasSubstr;
  using testing::ThrowsMessage;
  EXPECT_THAT([] { make_scene(room_with({{.radius_m = 0.0}}), 1); },
              ThrowsMessage<E>(HasSubstr("movers.0.radius: must be > 0 m, got 0")));
  EXPECT_THAT([] { make_scene(room_with({{.height_m = -2.0}}), 1); },
              ThrowsMessage<E>(HasSubstr("movers.0.height: must be > 0 m, got -2")));
  EXPECT_THAT(
      [] {
        make_scene(room_with({{}, {.motion = WaypointMotion{.points = {}}}}), 1);
      },
      ThrowsMessage<E>(testing::StartsWith("movers.1.motion.points: ")));
}

}  // namespace
}  // namespace hedgehop::scenes
