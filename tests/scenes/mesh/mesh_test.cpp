// Properties of every generated mesh: geometry, placement of textures, and agreement with the solids.
#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "scenes/generators.h"
#include "scenes/mesh/bodies.h"
#include "tests/scenes/scene_equality.h"

namespace hedgehop::scenes::mesh {
namespace {

struct Case {
  std::string name;
  SceneConfig config;
  bool is_boxy = true;  ///< every solid is an upright box along W's axes, drawn as one chunk
  bool is_flat = true;  ///< all faces have flat shading
  friend std::ostream& operator<<(std::ostream& out, const Case& each) { return out << each.name; }
};

std::vector<Case> cases() {
  worlds::UrbanConfig city;
  city.texture_size_px = 64;
  worlds::UrbanConfig towers = city;
  towers.setback_share = 1.0;
  towers.min_height_m = 4.0;
  towers.street_min_width_m = 9.3;
  worlds::RoomConfig room;
  room.texture_size_px = 64;
  room.furniture = 4;
  worlds::RoomConfig open = room;
  open.ceiling = false;
  open.length_m = 11.3;
  open.furniture_gap_m = 1.5;
  return {
      {"city", city},
      {"towers", towers},
      {"room", room},
      {"open", open},
      {"tree", worlds::TreeConfig{.texture_size_px = 64}, false, false},
      {"forest", worlds::ForestConfig{.trees = 30, .texture_size_px = 64}, false, false},
      {"corridor",
       worlds::CorridorConfig{.sections = {{12.0}, {8.0, 0.5, 2.0}, {9.0, -0.7, 3.0, 1.2}, {7.0, 0.2, 0.0, 0.0, -0.8}},
                              .texture_size_px = 64},
       false},
      {"highrise", worlds::HighriseConfig{.scale = 0.2, .texture_size_px = 64}, false},
      {"wall", worlds::WallConfig{.opening = worlds::WallOpening{.bottom_m = 2.0}, .texture_size_px = 64}},
      {"park", worlds::ParkConfig{.extent_m = 50.0, .texture_size_px = 64}, false, false}};
}

std::vector<Case> boxy_cases() {
  std::vector<Case> boxy = cases();
  std::erase_if(boxy, [](const Case& each) { return !each.is_boxy; });
  return boxy;
}

class EveryMesh : public testing::TestWithParam<Case> {
 protected:
  Scene scene_ = make_scene(GetParam().config, 11);
  const Mesh& mesh() const { return scene_.meshes.at(0); }
  const Vertex& corner(size_t triangle, size_t k) const { return mesh().vertices[mesh().indices[3 * triangle + k]]; }
  size_t triangles() const { return mesh().indices.size() / 3; }
};

TEST_P(EveryMesh, WindingAgreesWithUnitNormals) {
  for (size_t t = 0; t < triangles(); ++t) {
    const Eigen::Vector3f a = corner(t, 0).p_W, b = corner(t, 1).p_W, c = corner(t, 2).p_W;
    const Eigen::Vector3f across = (b - a).cross(c - a);
    ASSERT_GT(across.norm(), 0.0f);
    for (size_t k = 0; k < 3; ++k) {
      ASSERT_NEAR(corner(t, k).n_W.norm(), 1.0f, 1e-6f);
      // With smooth shading of a sharp lump, a narrow face may deviate from its corners' normals.
      ASSERT_GT(across.normalized().dot(corner(t, k).n_W), GetParam().is_flat ? 1.0f - 1e-5f : -0.5f);
    }
  }
}

TEST_P(EveryMesh, ImagesAreUprightAndNeverMirrored) {
  for (size_t t = 0; t < triangles(); ++t) {
    const Vertex &a = corner(t, 0), &b = corner(t, 1), &c = corner(t, 2);
    const Eigen::Vector3f e1 = b.p_W - a.p_W, e2 = c.p_W - a.p_W;
    const Eigen::Vector2f d1 = b.uv - a.uv, d2 = c.uv - a.uv;
    const float det = d1.x() * d2.y() - d2.x() * d1.y();
    const Eigen::Vector3f right = (e1 * d2.y() - e2 * d1.y()) / det, down = (e2 * d1.x() - e1 * d2.x()) / det;
    ASSERT_LT(right.cross(down).dot(e1.cross(e2)), 0.0f);
    if (GetParam().is_flat && std::abs(a.n_W.z()) < 0.1f) {
      ASSERT_GT(down.normalized().z(), 0.999f);
    }
    ASSERT_EQ(a.texture, b.texture);
    ASSERT_LT(a.texture, scene_.textures.size());
  }
}

TEST_P(EveryMesh, ChunksCoverAllIndicesInOrderAndBoundTheirTriangles) {
  uint32_t next = 0;
  for (const Chunk& chunk : mesh().chunks) {
    ASSERT_EQ(chunk.first_index, next);
    ASSERT_GT(chunk.index_count, 0u);
    ASSERT_EQ(chunk.index_count % 3, 0u);
    Eigen::AlignedBox3f box;
    for (uint32_t i = next; i < next + chunk.index_count; ++i) box.extend(mesh().vertices[mesh().indices[i]].p_W);
    ASSERT_EQ(box.min(), chunk.box_W.min());
    ASSERT_EQ(box.max(), chunk.box_W.max());
    next += chunk.index_count;
  }
  EXPECT_EQ(next, mesh().indices.size());
}

class EveryMeshOfBoxes : public EveryMesh {};

TEST_P(EveryMeshOfBoxes, EverySolidIsTheBoxOfOneChunkAndFillersReachTheGround) {
  std::vector<const Chunk*> upright;
  for (const Chunk& chunk : mesh().chunks) {
    if (chunk.box_W.sizes().z() > 0.0f) upright.push_back(&chunk);
  }
  ASSERT_EQ(upright.size(), scene_.solids.size());
  for (size_t k = 0; k < upright.size(); ++k) {
    const Eigen::AlignedBox3d solid = box_of(scene_.solids[k]);
    constexpr float kSinglePrecisionM = 1e-5f;
    ASSERT_LE((upright[k]->box_W.min() - solid.min().cast<float>()).cwiseAbs().maxCoeff(), kSinglePrecisionM);
    ASSERT_LE((upright[k]->box_W.max() - solid.max().cast<float>()).cwiseAbs().maxCoeff(), kSinglePrecisionM);
    if (!upright[k]->fills_box_to_ground) continue;
    // Every vertical line from the top to the ground is inside this solid or one below it.
    for (double height = 0.0; height < -solid.max().z(); height += 0.5) {
      const Eigen::Vector3d low(solid.min().x(), solid.min().y(), -height - 0.25),
          high(solid.max().x(), solid.max().y(), -height - 0.25);
      bool held = false;
      for (const Solid& other : scene_.solids)
        held = held || (box_of(other).contains(low) && box_of(other).contains(high));
      ASSERT_TRUE(held);
    }
  }
}

// Distance along a ray to the nearest triangle [Moeller and Trumbore]; sets whether its front faces the ray.
double cast_at_mesh(const Mesh& mesh, const Eigen::Vector3d& from_W, const Eigen::Vector3d& ray_W, bool& front) {
  double nearest = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Eigen::Vector3d a = mesh.vertices[mesh.indices[i]].p_W.cast<double>();
    const Eigen::Vector3d e1 = mesh.vertices[mesh.indices[i + 1]].p_W.cast<double>() - a;
    const Eigen::Vector3d e2 = mesh.vertices[mesh.indices[i + 2]].p_W.cast<double>() - a;
    const Eigen::Vector3d p = ray_W.cross(e2);
    const double det = e1.dot(p);
    if (std::abs(det) < 1e-12) continue;
    const Eigen::Vector3d s = from_W - a;
    const double u = s.dot(p) / det;
    const Eigen::Vector3d q = s.cross(e1);
    const double v = ray_W.dot(q) / det;
    const double t = e2.dot(q) / det;
    if (u < 0.0 || v < 0.0 || u + v > 1.0 || t <= 1e-9 || t >= nearest) continue;
    nearest = t;
    front = det > 0.0;
  }
  return nearest;
}

// In S; the enclosing box of a cylinder.
double cast_at_box(const Eigen::Vector3d& half_m, const Eigen::Vector3d& from_S, const Eigen::Vector3d& ray_S) {
  const Eigen::Array3d inverse = ray_S.array().inverse();
  const Eigen::Array3d t0 = (-half_m - from_S).array() * inverse, t1 = (half_m - from_S).array() * inverse;
  const double enter = t0.min(t1).maxCoeff(), leave = t0.max(t1).minCoeff();
  return enter <= leave && enter > 0.0 ? enter : std::numeric_limits<double>::infinity();
}

double cast_at_hull(const Polyhedron& hull, const Eigen::Vector3d& from_S, const Eigen::Vector3d& ray_S) {
  Mesh mesh;
  for (const Eigen::Vector3d& corner : hull.corners) mesh.vertices.push_back({corner.cast<float>()});
  for (const auto& face : hull.faces) mesh.indices.insert(mesh.indices.end(), face.begin(), face.end());
  bool front = true;
  return cast_at_mesh(mesh, from_S, ray_S, front);
}

// NaN if the ray meets the enclosing box of a cylinder, whose mesh is a prism slightly inside the solid.
double cast_at_solids(const Scene& scene, const Eigen::Vector3d& from_W, const Eigen::Vector3d& ray_W) {
  double nearest = ray_W.z() > 0.0 ? -from_W.z() / ray_W.z() : std::numeric_limits<double>::infinity();
  for (const Solid& solid : scene.solids) {
    const Eigen::Isometry3d X_SW = solid.X_WS.inverse();
    const Eigen::Vector3d from_S = X_SW * from_W, ray_S = X_SW.linear() * ray_W;
    if (solid.shape == Solid::Shape::hull) {
      nearest = std::min(nearest, cast_at_hull(solid.polyhedron, from_S, ray_S));
      continue;
    }
    const double box = cast_at_box(solid.half_extents_m, from_S, ray_S);
    if (solid.shape == Solid::Shape::cylinder && std::isfinite(box)) return std::nan("");
    nearest = std::min(nearest, box);
  }
  return nearest;
}

TEST_P(EveryMesh, SurfaceAgreesWithTheSolids) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  constexpr double kMaxCoordinateM = 1000.0;  // the ground's mesh is finite, its plane is not
  constexpr int kRays = 400, kMaxTries = 200'000;
  int compared = 0;
  for (int i = 0; i < kMaxTries && compared < kRays; ++i) {
    const Eigen::Vector2d half = 0.5 * scene_.bounds_NE_m.sizes();
    const Eigen::Vector3d from_W(half.x() * share(random), half.y() * share(random), -1.45 + share(random));
    const Eigen::Vector3d ray_W = Eigen::Vector3d(share(random), share(random), share(random)).normalized();
    bool in_solid = false;
    for (const Solid& solid : scene_.solids) in_solid = in_solid || bounds_W(solid).contains(from_W);
    if (in_solid) continue;
    const double truth = cast_at_solids(scene_, from_W, ray_W);
    if (std::isnan(truth)) continue;
    if (truth > kMaxCoordinateM && truth < std::numeric_limits<double>::infinity()) continue;
    bool front = true;
    const double seen = cast_at_mesh(mesh(), from_W, ray_W, front);
    if (std::isinf(truth)) {
      ASSERT_TRUE(std::isinf(seen));
    } else {
      ASSERT_NEAR(seen, truth, 1e-4);
    }
    ASSERT_TRUE(front);
    ++compared;
  }
  ASSERT_EQ(compared, kRays);
}

// Singular values of the map from a face to its texture, in repeats per tile; 1 without stretching.
TEST(AddPolyhedron, StretchesNoFacesImageByMoreThanAnEighth) {
  constexpr double kTileM = 2.0;
  MeshBuilder builder("opaque");
  builder.begin_chunk(false);
  add_polyhedron(ball(4), Shading::smooth, {0, kTileM}, builder);
  const Mesh mesh = builder.finish();
  float least = 1.0f, most = 1.0f;
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vertex &a = mesh.vertices[mesh.indices[i]], &b = mesh.vertices[mesh.indices[i + 1]],
                 &c = mesh.vertices[mesh.indices[i + 2]];
    Eigen::Matrix<float, 3, 2> edges_m;
    edges_m << b.p_W - a.p_W, c.p_W - a.p_W;
    Eigen::Matrix2f edges_in_image;
    edges_in_image << b.uv - a.uv, c.uv - a.uv;
    const Eigen::Vector2f scales =
        (edges_m * edges_in_image.inverse()).jacobiSvd().singularValues() / static_cast<float>(kTileM);
    least = std::min(least, scales.minCoeff());
    most = std::max(most, scales.maxCoeff());
  }
  EXPECT_GT(least, 0.99f);
  EXPECT_LT(most, 1.13f);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryMesh, testing::ValuesIn(cases()),
                         [](const auto& each) { return each.param.name; });
INSTANTIATE_TEST_SUITE_P(Scenes, EveryMeshOfBoxes, testing::ValuesIn(boxy_cases()),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace hedgehop::scenes::mesh
