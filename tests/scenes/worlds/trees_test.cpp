// Geometry of a tree and of a forest.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>

#include "scenes/generators.h"
#include "tests/scenes/scene_equality.h"

namespace hedgehop::scenes::worlds {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr int64_t kSmallPx = 64;

TEST(Tree, HasACrownOfTenMetersAndAHeightOfTwelve) {
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

// Returns the distance along a ray from inside a convex body to its surface.
double way_out(const Solid& body, const Vector3d& from_W, const Vector3d& along_W) {
  double way_m = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : body.polyhedron.faces) {
    const Vector3d p = body.X_WS * body.polyhedron.corners[a], q = body.X_WS * body.polyhedron.corners[b],
                   r = body.X_WS * body.polyhedron.corners[c], n = (q - p).cross(r - p);
    if (n.dot(along_W) > 0.0) way_m = std::min(way_m, n.dot(p - from_W) / n.dot(along_W));
  }
  return way_m;
}

TEST(Tree, LobesTouchTheCrown) {
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

TEST(Forest, FarDetailOmitsOnlyTrunks) {
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

TEST(Forest, RejectsMoreTreesThanFit) {
  const ForestConfig config{.trees = 30, .keep_clear = {{0.0, 0.0, 14.0}}, .texture_size_px = kSmallPx};
  EXPECT_THAT([&] { make_forest(config, 1); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("trees: 30; valid: at most ")));
  EXPECT_THAT([] { make_forest({.clear_height_m = 9.0}, 1); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("clear_height: 9")));
}

}  // namespace
}  // namespace hedgehop::scenes::worlds
