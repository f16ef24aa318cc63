// Geometry of the smaller worlds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "scenes/generators.h"
#include "scenes/textures/stone_textures.h"
#include "tests/scenes/scene_equality.h"

namespace hedgehop::scenes::worlds {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr int64_t kWorldTexturePx = 64;

bool inside_a_box(const Scene& scene, const Vector3d& p_W) {
  return std::ranges::any_of(scene.solids, [&](const Solid& solid) {
    const Vector3d p_S = solid.X_WS.inverse() * p_W;
    return solid.shape == Solid::Shape::box && (p_S.cwiseAbs().array() < solid.half_extents_m.array()).all();
  });
}

std::vector<SceneConfig> small_worlds() {
  return {
      TreeConfig{.texture_size_px = kWorldTexturePx},     ForestConfig{.trees = 50, .texture_size_px = kWorldTexturePx},
      CorridorConfig{.texture_size_px = kWorldTexturePx}, HighriseConfig{.texture_size_px = kWorldTexturePx},
      BalloonConfig{.texture_size_px = kWorldTexturePx},  WallConfig{.texture_size_px = kWorldTexturePx},
      ParkConfig{.texture_size_px = kWorldTexturePx}};
}

TEST(Worlds, DependOnTheSeedOnly) {
  for (const SceneConfig& config : small_worlds()) {
    const Scene scene = make_scene(config, 4);
    EXPECT_TRUE(identical(scene, make_scene(config, 4))) << scene.name;
    EXPECT_FALSE(identical(scene, make_scene(config, 5))) << scene.name;
  }
}

TEST(Worlds, RejectTextureSizesThatAreNotPowersOfTwo) {
  for (SceneConfig config : small_worlds()) {
    const auto resize = [](auto& chosen) {
      if constexpr (requires { chosen.texture_size_px; }) chosen.texture_size_px = 100;
    };
    std::visit(resize, config);
    EXPECT_THAT([&] { make_scene(config, 1); }, ThrowsMessage<std::invalid_argument>(HasSubstr("texture_size: 100")));
  }
}

TEST(Corridor, HasItsConfiguredWidthInEverySection) {
  CorridorConfig config{.width_m = 4.0, .texture_size_px = kWorldTexturePx};
  config.sections = {{10.0}, {12.0, 0.7}, {8.0, -0.4, 2.8}, {8.0, 0.0, 4.0}, {15.0, -0.78}};
  const Scene scene = make_corridor(config, 1);
  const double ends_m[] = {4.0, 4.0, 4.0, 2.8, 4.0, 4.0};
  double heading_rad = 0.0;
  Vector2d from = Vector2d::Zero();
  for (size_t k = 0; k < config.sections.size(); ++k) {
    heading_rad += config.sections[k].bend_rad;
    const Vector2d along(std::cos(heading_rad), std::sin(heading_rad)), right(-along.y(), along.x());
    for (const double share : {0.4, 0.5, 0.6}) {
      const Vector2d middle = from + share * config.sections[k].length_m * along;
      const double half_m = 0.5 * (ends_m[k] + share * (ends_m[k + 1] - ends_m[k]));
      // If the corridor narrows, its corners lie across the bend, which changes the taper slightly.
      const double slack_m = ends_m[k] == ends_m[k + 1] ? 1e-6 : 0.1;
      for (const double side : {-1.0, 1.0}) {
        const Vector2d inner = middle + side * (half_m - slack_m) * right,
                       outer = middle + side * (half_m + slack_m) * right;
        EXPECT_FALSE(inside_a_box(scene, {inner.x(), inner.y(), -1.5})) << "section " << k;
        EXPECT_TRUE(inside_a_box(scene, {outer.x(), outer.y(), -1.5})) << "section " << k;
      }
    }
    from += config.sections[k].length_m * along;
  }
}

TEST(Corridor, IsClosedAtItsBends) {
  CorridorConfig config{.texture_size_px = kWorldTexturePx};
  config.sections = {{6.0}, {6.0, 0.785}, {6.0, -0.785}, {6.0, -0.35, 1.8}, {6.0, 0.52}};
  const Scene scene = make_corridor(config, 2);
  const CorridorPlan plan = plan_corridor(config, 2);
  for (const std::vector<Vector2d>& wall : {plan.lefts_NE, plan.rights_NE}) {
    for (size_t k = 0; k < wall.size(); ++k) {
      const Vector2d out = (wall[k] - plan.middles_NE[k]).normalized();
      const Vector2d p = wall[k] + 0.01 * out;
      EXPECT_TRUE(inside_a_box(scene, {p.x(), p.y(), -1.0})) << "corner " << k;
    }
  }
}

TEST(Corridor, DoorwayAndPillarLeaveTheConfiguredWidth) {
  CorridorConfig config{.width_m = 3.0, .texture_size_px = kWorldTexturePx};
  config.sections = {{10.0, 0.0, 0.0, 1.2, 0.0}, {10.0, 0.0, 0.0, 0.0, 0.7}};
  const Scene scene = make_corridor(config, 1);
  const auto free_at = [&](double north_m, double east_m, double up_m) {
    return !inside_a_box(scene, {north_m, east_m, -up_m});
  };
  EXPECT_TRUE(free_at(5.0, 0.599, 1.0) && free_at(5.0, -0.599, 2.09));
  EXPECT_FALSE(free_at(5.0, 0.601, 1.0) || free_at(5.0, -0.601, 1.0) || free_at(5.0, 0.0, 2.11));
  EXPECT_TRUE(free_at(15.0, 0.799, 1.0) && free_at(15.0, -1.499, 1.0));
  EXPECT_FALSE(free_at(15.0, 0.801, 1.0));
}

TEST(Corridor, TextureScalesTheContrastOfItsWalls) {
  const auto contrast = [](double texture) {
    cv::Scalar mean, deviation;
    cv::meanStdDev(make_corridor({.texture = texture, .texture_size_px = 128}, 1).textures.images().at(0), mean,
                   deviation);
    return deviation[0];
  };
  EXPECT_EQ(contrast(0.0), 0.0);
  EXPECT_GT(contrast(1.0), 20.0);
  EXPECT_NEAR(contrast(0.5), 0.5 * contrast(1.0), 0.5);  // grey levels are whole numbers
}

TEST(Corridor, PlainWallsDoNotChangeTheFloor) {
  const auto contrast = [](const CorridorConfig& config, size_t image) {
    cv::Scalar mean, deviation;
    cv::meanStdDev(make_corridor(config, 1).textures.images().at(image), mean, deviation);
    return deviation[0];
  };
  constexpr size_t kWall = 0, kFloor = 3;
  const CorridorConfig plain_walls{.texture = 0.0, .texture_size_px = 128};
  const CorridorConfig plain_floor{.floor_texture = 0.0, .texture_size_px = 128};
  EXPECT_EQ(contrast(plain_walls, kWall), 0.0);
  EXPECT_GT(contrast(plain_walls, kFloor), 5.0);
  EXPECT_GT(contrast(plain_floor, kWall), 20.0);
  EXPECT_EQ(contrast(plain_floor, kFloor), 0.0);
}

TEST(Highrise, HasEightCornersOrThirtyFiveAndDrawsThem) {
  for (const auto& [layout, count] :
       {std::pair{HighriseConfig::Layout::cube, 8u}, {HighriseConfig::Layout::skyline, 35u}}) {
    const HighriseConfig config{.layout = layout, .texture_size_px = kWorldTexturePx};
    const std::vector<Vector3d> corners = highrise_corners(config, 1);
    EXPECT_EQ(corners.size(), count);
    const Scene scene = make_highrise(config, 1);
    EXPECT_EQ(scene.corners_W, corners);
    for (const Vector3d& corner : corners) {
      EXPECT_TRUE(std::ranges::any_of(scene.meshes[0].vertices, [&](const Vertex& vertex) {
        return (vertex.p_W.cast<double>() - corner).norm() < 1e-4;
      })) << corner.transpose();
    }
  }
}

TEST(Wall, IsOpenInItsOpeningAndClosedAroundIt) {
  const WallConfig config{.opening = WallOpening{.middle_m = 4.0, .bottom_m = 2.0, .width_m = 3.0, .height_m = 5.0},
                          .texture_size_px = kWorldTexturePx};
  const Scene scene = make_wall(config, 1);
  for (double east_m = -14.9; east_m < 15.0; east_m += 0.37) {
    for (double up_m = 0.1; up_m < 10.0; up_m += 0.23) {
      const bool open = std::abs(east_m - 4.0) < 1.5 && up_m > 2.0 && up_m < 7.0;
      ASSERT_EQ(inside_a_box(scene, {20.2, east_m, -up_m}), !open) << east_m << " " << up_m;
    }
  }
  EXPECT_FALSE(inside_a_box(scene, {19.9, 0.0, -1.0}) || inside_a_box(scene, {20.5, 0.0, -1.0}));
  EXPECT_THAT([] { make_wall({.opening = WallOpening{.bottom_m = 8.0}}, 1); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("opening.bottom: 8")));
}

// Returns the smaller eigenvalue of the gradients at the best corner, as used by corner detectors.
double best_corner(const cv::Mat& image) {
  cv::Mat grey, strength;
  cv::cvtColor(image, grey, cv::COLOR_RGB2GRAY);
  cv::cornerMinEigenVal(grey, strength, 3);
  double best = 0.0;
  cv::minMaxLoc(strength, nullptr, &best);
  return best;
}

TEST(Wall, CloudsHaveGradientsButNoCorners) {
  constexpr int kSizePx = 512;
  const cv::Mat clouds = textures::paint_clouded_wall(kSizePx, 1), bricks = textures::paint_brick_wall(kSizePx, 1);
  EXPECT_LT(best_corner(clouds), 0.01 * best_corner(bricks));
  cv::Scalar mean, deviation;
  cv::meanStdDev(clouds, mean, deviation);
  EXPECT_GT(deviation[0], 15.0);
  cv::meanStdDev(textures::paint_blank(kSizePx, {0.5f, 0.5f, 0.5f}), mean, deviation);
  EXPECT_EQ(deviation[0], 0.0);
}

TEST(Park, KeepsItsClearingAndTheRoadFree) {
  for (uint64_t seed = 0; seed < 5; ++seed) {
    const Scene scene = make_park({.texture_size_px = kWorldTexturePx}, seed);
    for (const Solid& solid : scene.solids) {
      const Eigen::AlignedBox3d box = bounds_W(solid);
      EXPECT_GE(Vector2d(box.min().head<2>().cwiseMax(-box.max().head<2>()).cwiseMax(0.0)).norm(), 0.9 * 4.0)
          << solid.name;
      EXPECT_GT(std::max(box.min().y(), -box.max().y()), 3.0) << solid.name;
    }
  }
  EXPECT_THAT([] { make_park({.extent_m = 40.0, .trees = 500, .vehicles = 0, .texture_size_px = kWorldTexturePx}, 1); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("trees: no free position after")));
}

TEST(Balloon, ApproachesAtAHeightOfTwentyFeet) {
  const Scene scene = make_balloon({.texture_size_px = kWorldTexturePx}, 1);
  ASSERT_EQ(scene.movers.size(), 1u);
  const Solid& balloon = scene.movers[0].solids.at(0);
  EXPECT_EQ(balloon.shape, Solid::Shape::sphere);
  EXPECT_NEAR(-balloon.X_WS.translation().z(), 6.1, 1e-12);
  EXPECT_NEAR(p_WM(scene.movers[0].motion, 0.0).x(), 15.25, 1e-12);
  EXPECT_NEAR(p_WM(scene.movers[0].motion, 60.0).x(), 3.05, 1e-12);
}

}  // namespace
}  // namespace hedgehop::scenes::worlds
