// What each of the smaller worlds promises of its geometry.
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
using E = std::invalid_argument;

constexpr int64_t kSmallPx = 64;

bool inside_a_box(const Scene& scene, const Vector3d& p_W) {
  return std::ranges::any_of(scene.solids, [&](const Solid& solid) {
    const Vector3d p_S = solid.X_WS.inverse() * p_W;
    return solid.shape == Solid::Shape::box && (p_S.cwiseAbs().array() < solid.half_extents_m.array()).all();
  });
}

std::vector<SceneConfig> small_worlds() {
  return {TreeConfig{.texture_size_px = kSmallPx},     ForestConfig{.trees = 50, .texture_size_px = kSmallPx},
          CorridorConfig{.texture_size_px = kSmallPx}, HighriseConfig{.texture_size_px = kSmallPx},
          BalloonConfig{.texture_size_px = kSmallPx},  WallConfig{.texture_size_px = kSmallPx},
          ParkConfig{.texture_size_px = kSmallPx}};
}

TEST(Worlds, AreTheSameForTheSameSeedAndOthersForAnother) {
  for (const SceneConfig& config : small_worlds()) {
    const Scene scene = make_scene(config, 4);
    EXPECT_TRUE(identical(scene, make_scene(config, 4))) << scene.name;
    EXPECT_FALSE(identical(scene, make_scene(config, 5))) << scene.name;
  }
}

TEST(Worlds, RefuseImagesOfOddSizes) {
  for (SceneConfig config : small_worlds()) {
    std::visit([](auto& chosen) { chosen.texture_size_px = 100; }, config);
    EXPECT_THAT([&] { make_scene(config, 1); }, ThrowsMessage<E>(HasSubstr("texture_size: 100")));
  }
}

TEST(Tree, CrownIsTenMetersAcrossAndTheTreeTwelveHigh) {
  for (uint64_t seed = 0; seed < 10; ++seed) {
    const Scene scene = make_tree({.north_m = 3.0, .east_m = -2.0, .texture_size_px = kSmallPx}, seed);
    Eigen::AlignedBox3d box;
    double farthest_m = 0.0;
    for (const Solid& solid : scene.solids) {
      box.extend(bounds_W(solid));
      for (const Vector3d& corner : solid.polyhedron.corners) {
        farthest_m = std::max(farthest_m, (solid.X_WS * corner - Vector3d(3.0, -2.0, 0.0)).head<2>().norm());
      }
    }
    EXPECT_LE(farthest_m, 5.0 + 1e-9);
    EXPECT_GE(box.sizes().head<2>().minCoeff(), 8.5);
    EXPECT_LE(-box.min().z(), 12.0 + 1e-9);
    EXPECT_GE(-box.min().z(), 11.0);
    EXPECT_NEAR(box.max().z(), 0.0, 1e-9);
  }
}

// How far along a line out of a convex body its surface lies.
double way_out(const Solid& body, const Vector3d& from_W, const Vector3d& along_W) {
  double way_m = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : body.polyhedron.faces) {
    const Vector3d p = body.X_WS * body.polyhedron.corners[a], q = body.X_WS * body.polyhedron.corners[b],
                   r = body.X_WS * body.polyhedron.corners[c], n = (q - p).cross(r - p);
    if (n.dot(along_W) > 0.0) way_m = std::min(way_m, n.dot(p - from_W) / n.dot(along_W));
  }
  return way_m;
}

TEST(Tree, HasNoLobeThatFloatsBesideItsCrown) {
  for (uint64_t seed = 0; seed < 30; ++seed) {
    const Scene scene = make_tree({.texture_size_px = kSmallPx}, seed);
    const Solid& core = scene.solids.at(1);
    for (size_t k = 2; k < scene.solids.size(); ++k) {
      const Solid& lobe = scene.solids[k];
      const Vector3d between_W = lobe.X_WS.translation() - core.X_WS.translation(), out = between_W.normalized();
      EXPECT_GT(way_out(core, core.X_WS.translation(), out) + way_out(lobe, lobe.X_WS.translation(), -out),
                between_W.norm())
          << "lobe " << k << " of seed " << seed;
    }
  }
}

TEST(Forest, CrownsAreWidestBelowTheirMiddle) {
  const Scene scene = make_forest({.trees = 200, .texture_size_px = kSmallPx}, 3);
  double sum = 0.0;
  int crowns = 0;
  for (const Solid& solid : scene.solids) {
    if (solid.shape != Solid::Shape::hull) continue;
    const auto widest =
        std::ranges::max_element(solid.polyhedron.corners, {}, [](const Vector3d& p) { return p.head<2>().norm(); });
    sum += 0.5 - 0.5 * widest->z() / solid.half_extents_m.z();  // 0 at the bottom, 1 on top
    ++crowns;
  }
  EXPECT_EQ(crowns, 200);
  EXPECT_LT(sum / crowns, 0.4);
}

TEST(Forest, KeepsItsSpacingAndItsClearings) {
  ForestConfig config{.trees = 400, .keep_clear = {{5.0, -3.0, 8.0}}, .texture_size_px = kSmallPx};
  for (uint64_t seed = 0; seed < 3; ++seed) {
    const Scene scene = make_forest(config, seed);
    std::vector<Vector2d> trunks;
    for (const Solid& solid : scene.solids) {
      const Eigen::AlignedBox3d box = bounds_W(solid);
      const Vector2d nearest = Vector2d(5.0, -3.0).cwiseMax(box.min().head<2>()).cwiseMin(box.max().head<2>());
      if (solid.shape == Solid::Shape::cylinder) {
        trunks.push_back(solid.X_WS.translation().head<2>());
        EXPECT_GE((nearest - Vector2d(5.0, -3.0)).norm(), 8.0);
      }
      for (const Vector3d& corner : solid.polyhedron.corners) {
        EXPECT_GE(((solid.X_WS * corner).head<2>() - Vector2d(5.0, -3.0)).norm(), 8.0);
      }
    }
    ASSERT_EQ(trunks.size(), 400u);
    for (size_t i = 0; i < trunks.size(); ++i) {
      ASSERT_LE(trunks[i].cwiseAbs().maxCoeff(), 0.5 * config.extent_m());
      for (size_t j = 0; j < i; ++j) ASSERT_GE((trunks[i] - trunks[j]).norm(), config.spacing_m);
    }
  }
}

TEST(Forest, OfTenThousandTreesHasFewTrianglesEach) {
  const Scene scene = make_forest({.trees = 10000, .texture_size_px = kSmallPx}, 1);
  EXPECT_EQ(scene.solids.size(), 20000u);
  EXPECT_LE(scene.meshes.at(0).indices.size() / 3, 150u * 10000u);
}

TEST(Forest, LeavesOnlyTrunksOutFromAfar) {
  const Scene scene = make_forest({.trees = 1200, .texture_size_px = kSmallPx}, 2);
  const Mesh& mesh = scene.meshes.at(0);
  const auto triangles = [](const std::vector<uint32_t>& indices, uint32_t first, uint32_t count) {
    std::vector<std::array<uint32_t, 3>> found;
    for (uint32_t i = first; i < first + count; i += 3) found.push_back({indices[i], indices[i + 1], indices[i + 2]});
    std::ranges::sort(found);
    return found;
  };
  size_t left_out = 0;
  for (const Chunk& chunk : mesh.chunks) {
    if (chunk.far.index_count == 0) continue;
    const auto whole = triangles(mesh.indices, chunk.first_index, chunk.index_count);
    const auto far = triangles(mesh.far_indices, chunk.far.first_index, chunk.far.index_count);
    ASSERT_TRUE(std::ranges::includes(whole, far));
    std::vector<std::array<uint32_t, 3>> gone;
    std::ranges::set_difference(whole, far, std::back_inserter(gone));
    left_out += gone.size();
    for (const std::array<uint32_t, 3>& triangle : gone) {
      for (const uint32_t corner : triangle) ASSERT_GE(mesh.vertices[corner].texture, 4u);  // bark
    }
  }
  EXPECT_GE(left_out, 7u * 1200u);  // three-sided and more: two to a side, and the top
  EXPECT_TRUE(make_forest({.trees = 1000, .texture_size_px = kSmallPx}, 2).meshes.at(0).far_indices.empty());
}

TEST(Forest, RefusesMoreTreesThanFit) {
  const ForestConfig config{.trees = 30, .keep_clear = {{0.0, 0.0, 14.0}}, .texture_size_px = kSmallPx};
  EXPECT_THAT([&] { make_forest(config, 1); }, ThrowsMessage<E>(HasSubstr("trees: 30; valid: what fits: ")));
  EXPECT_THAT([] { make_forest({.clear_height_m = 9.0}, 1); }, ThrowsMessage<E>(HasSubstr("clear_height: 9")));
}

TEST(Corridor, IsAsWideAsAskedInEverySection) {
  CorridorConfig config{.width_m = 4.0, .texture_size_px = kSmallPx};
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
      // Where the corridor narrows its corners are cut across the bend, so that the taper is off by a little.
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

TEST(Corridor, LetsNobodyOutAtItsBends) {
  CorridorConfig config{.texture_size_px = kSmallPx};
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

TEST(Corridor, DoorwayAndPillarLeaveTheWidthThatTheySay) {
  CorridorConfig config{.width_m = 3.0, .texture_size_px = kSmallPx};
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

TEST(Corridor, WithoutTextureIsOneColorAndWithHalfOfItHalfAsContrasted) {
  const auto contrast = [](double texture) {
    cv::Scalar mean, deviation;
    cv::meanStdDev(make_corridor({.texture = texture, .texture_size_px = 128}, 1).textures.at(0), mean, deviation);
    return deviation[0];
  };
  EXPECT_EQ(contrast(0.0), 0.0);
  EXPECT_GT(contrast(1.0), 20.0);
  EXPECT_NEAR(contrast(0.5), 0.5 * contrast(1.0), 0.5);  // grey levels are whole numbers
}

TEST(Corridor, PlainWallsLeaveTheFloorItsTexture) {
  const auto contrast = [](const CorridorConfig& config, size_t image) {
    cv::Scalar mean, deviation;
    cv::meanStdDev(make_corridor(config, 1).textures.at(image), mean, deviation);
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
    const HighriseConfig config{.layout = layout, .texture_size_px = kSmallPx};
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
                          .texture_size_px = kSmallPx};
  const Scene scene = make_wall(config, 1);
  for (double east_m = -14.9; east_m < 15.0; east_m += 0.37) {
    for (double up_m = 0.1; up_m < 10.0; up_m += 0.23) {
      const bool open = std::abs(east_m - 4.0) < 1.5 && up_m > 2.0 && up_m < 7.0;
      ASSERT_EQ(inside_a_box(scene, {20.2, east_m, -up_m}), !open) << east_m << " " << up_m;
    }
  }
  EXPECT_FALSE(inside_a_box(scene, {19.9, 0.0, -1.0}) || inside_a_box(scene, {20.5, 0.0, -1.0}));
  EXPECT_THAT([] { make_wall({.opening = WallOpening{.bottom_m = 8.0}}, 1); },
              ThrowsMessage<E>(HasSubstr("opening.bottom: 8")));
}

// The smaller eigenvalue of the gradients around the best corner, as detectors of corners rank them.
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
    const Scene scene = make_park({.texture_size_px = kSmallPx}, seed);
    for (const Solid& solid : scene.solids) {
      const Eigen::AlignedBox3d box = bounds_W(solid);
      EXPECT_GE(Vector2d(box.min().head<2>().cwiseMax(-box.max().head<2>()).cwiseMax(0.0)).norm(), 0.9 * 4.0)
          << solid.name;
      EXPECT_GT(std::max(box.min().y(), -box.max().y()), 3.0) << solid.name;
    }
  }
  EXPECT_THAT([] { make_park({.extent_m = 40.0, .trees = 500, .vehicles = 0, .texture_size_px = kSmallPx}, 1); },
              ThrowsMessage<E>(HasSubstr("trees: valid: fewer")));
}

TEST(Balloon, ComesNearAtTwentyFeet) {
  const Scene scene = make_balloon({.texture_size_px = kSmallPx}, 1);
  ASSERT_EQ(scene.movers.size(), 1u);
  const Solid& balloon = scene.movers[0].solids.at(0);
  EXPECT_EQ(balloon.shape, Solid::Shape::sphere);
  EXPECT_NEAR(-balloon.X_WS.translation().z(), 6.1, 1e-12);
  EXPECT_NEAR(p_WM(scene.movers[0].motion, 0.0).x(), 15.25, 1e-12);
  EXPECT_NEAR(p_WM(scene.movers[0].motion, 60.0).x(), 3.05, 1e-12);
}

}  // namespace
}  // namespace hedgehop::scenes::worlds
