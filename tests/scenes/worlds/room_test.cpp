#include "scenes/worlds/room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "scenes/generators.h"
#include "tests/scenes/scene_equality.h"

namespace hedgehop::scenes::worlds {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

RoomConfig room_with_small_images() {
  RoomConfig config;
  config.texture_size_px = 64;
  return config;
}

bool inside_a_solid(const Scene& scene, const Eigen::Vector3d& p_W) {
  for (const Solid& solid : scene.solids) {
    if (((p_W - solid.X_WS.translation()).cwiseAbs().array() < solid.half_extents_m.array()).all()) return true;
  }
  return false;
}

TEST(Room, FreeSpaceIsEightBySixteenMetersAndClosed) {
  const Scene room = make_room(room_with_small_images(), 1);
  EXPECT_EQ(room.bounds_NE_m.sizes(), Eigen::Vector2d(16.0, 8.0));
  EXPECT_TRUE(room.has_ground);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  constexpr double kHairM = 1e-6;
  for (int k = 0; k < 2000; ++k) {
    const Eigen::Vector3d p_W(8.0 * share(random), 4.0 * share(random), -1.5 + 1.5 * share(random));
    ASSERT_FALSE(inside_a_solid(room, p_W));
    // In each direction there is a wall directly behind the surface.
    for (double sign : {-1.0, 1.0}) {
      ASSERT_TRUE(inside_a_solid(room, {sign * (8.0 + kHairM), p_W.y(), p_W.z()}));
      ASSERT_TRUE(inside_a_solid(room, {p_W.x(), sign * (4.0 + kHairM), p_W.z()}));
      ASSERT_FALSE(inside_a_solid(room, {sign * (8.0 - kHairM), p_W.y(), p_W.z()}));
      ASSERT_FALSE(inside_a_solid(room, {p_W.x(), sign * (4.0 - kHairM), p_W.z()}));
    }
    ASSERT_TRUE(inside_a_solid(room, {p_W.x(), p_W.y(), -3.0 - kHairM}));
  }
}

TEST(Room, WithoutCeilingOnlyWallsRemain) {
  RoomConfig config = room_with_small_images();
  config.ceiling = false;
  const Scene room = make_room(config, 1);
  EXPECT_EQ(room.solids.size(), 4u);
  EXPECT_FALSE(inside_a_solid(room, {0.0, 0.0, -3.1}));
}

TEST(Room, FurnitureKeepsItsGapsAndTheClearings) {
  for (uint64_t seed = 0; seed < 40; ++seed) {
    RoomConfig config = room_with_small_images();
    config.furniture = 4;
    const Scene room = make_room(config, seed);
    ASSERT_EQ(room.solids.size(), 9u);
    std::vector<Eigen::AlignedBox3d> pieces;
    for (size_t k = 5; k < room.solids.size(); ++k) pieces.push_back(box_of(room.solids[k]));
    for (size_t i = 0; i < pieces.size(); ++i) {
      ASSERT_NEAR(pieces[i].max().z(), 0.0, 1e-9);
      for (size_t j = 0; j < 5; ++j) {
        const double gap = pieces[i].exteriorDistance(box_of(room.solids[j]));
        ASSERT_FALSE(pieces[i].intersection(box_of(room.solids[j])).volume() > 1e-9 && gap == 0.0);
        if (j < 4) {
          ASSERT_TRUE(gap < 1e-9 || gap >= config.furniture_gap_m - 1e-9) << gap;
        }
      }
      for (size_t j = i + 1; j < pieces.size(); ++j) {
        Eigen::AlignedBox3d a = pieces[i], b = pieces[j];
        a.min().z() = b.min().z() = -1.0;
        ASSERT_GE(a.exteriorDistance(b), config.furniture_gap_m);
      }
      const Eigen::Vector3d center(0.0, 0.0, pieces[i].center().z());
      ASSERT_GE(pieces[i].exteriorDistance(center), 2.0);
    }
  }
}

TEST(Room, DependsOnTheSeedOnly) {
  RoomConfig config = room_with_small_images();
  config.furniture = 3;
  EXPECT_TRUE(identical(make_scene(config, 4), make_scene(config, 4)));
  EXPECT_FALSE(identical(make_scene(config, 4), make_scene(config, 5)));
}

TEST(Room, RejectsInvalidConfigs) {
  const auto refused = [](auto change) {
    RoomConfig config = room_with_small_images();
    change(config);
    return [config] { make_room(config, 1); };
  };
  EXPECT_THAT(refused([](auto& c) { c.length_m = 0.0; }),
              ThrowsMessage<std::invalid_argument>(HasSubstr("length: must be >= 1 m, got 0")));
  EXPECT_THAT(refused([](auto& c) { c.furniture = -1; }),
              ThrowsMessage<std::invalid_argument>(HasSubstr("furniture: must be >= 0, got -1")));
  EXPECT_THAT(refused([](auto& c) { c.furniture = 200; }),
              ThrowsMessage<std::invalid_argument>(HasSubstr("furniture: 200; valid: at most ")));
  EXPECT_THAT(refused([](auto& c) { c.texture_size_px = 8; }),
              ThrowsMessage<std::invalid_argument>(HasSubstr("texture_size: must be >= 64 px, got 8")));
}

}  // namespace
}  // namespace hedgehop::scenes::worlds
