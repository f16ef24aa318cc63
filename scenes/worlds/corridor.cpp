#include "scenes/worlds/corridor.h"

#include <algorithm>
#include <cmath>

#include "scenes/mesh/bodies.h"
#include "scenes/textures/room_textures.h"
#include "scenes/textures/stone_textures.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes::worlds {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr uint64_t kCorridorImageStream = 0, kOffsetStream = 1;  // of the scene's seed; the plan's is 2

constexpr double kThicknessM = 0.2;  // of walls and ceiling
constexpr double kPillarLengthM = 0.6;
constexpr int kWalls = 3;  // images
constexpr uint32_t kFloor = kWalls, kCeiling = kWalls + 1;

bool turns_right(const Vector2d& before, const Vector2d& after) { return to_the_right(before).dot(after) > 0.0; }

// Returns the pose of a frame K on the floor: x along a direction in the plan, y to the right, z down.
Eigen::Isometry3d floor_frame(const Vector2d& origin_NE, const Vector2d& along_NE) {
  Eigen::Isometry3d X_WK = Eigen::Isometry3d::Identity();
  const Vector2d right = to_the_right(along_NE);
  X_WK.linear().col(0) = Vector3d(along_NE.x(), along_NE.y(), 0.0);
  X_WK.linear().col(1) = Vector3d(right.x(), right.y(), 0.0);
  X_WK.translation() = Vector3d(origin_NE.x(), origin_NE.y(), 0.0);
  return X_WK;
}

// Adds boxes to a mesh and to the solids. Each box is a chunk with a random texture. The boxes since begin() are one
// instance.
class WallBuilder {
 public:
  WallBuilder(uint64_t seed, Scene& scene, mesh::MeshBuilder& mesh) : random_(seed), scene_(scene), mesh_(mesh) {}

  void begin(const std::string& name) {
    name_ = name;
    mesh_.begin_instance(name, SemanticClass::wall);
  }

  void build(const Eigen::AlignedBox3d& box_K, const Eigen::Isometry3d& X_WK) {
    const Vector2d offset(uniform(random_, 0.0, 1.0), 0.0);
    mesh_.begin_chunk(false);
    mesh::add_box(box_K, X_WK, {static_cast<uint32_t>(uniform_index(random_, kWalls)), textures::kWallTileM, offset},
                  mesh_);
    scene_.solids.push_back(mesh::solid_of(name_, box_K, X_WK));
  }

  /// Builds a wall along a path in the plan, on its left side. At right turns and at both ends the sections extend past
  /// the corner, which closes the wedge behind it.
  void build_wall(const std::string& name, const std::vector<Vector2d>& path_NE, double height_m) {
    begin(name);
    for (size_t k = 1; k < path_NE.size(); ++k) {
      const Vector2d from = path_NE[k - 1], along = (path_NE[k] - from).normalized();
      const bool on_before = k == 1 || turns_right(from - path_NE[k - 2], along);
      const bool on_after = k + 1 == path_NE.size() || turns_right(along, path_NE[k + 1] - path_NE[k]);
      const double first_m = on_before ? -kThicknessM : 0.0;
      const double last_m = (path_NE[k] - from).norm() + (on_after ? kThicknessM : 0.0);
      build({Vector3d(first_m, -kThicknessM, -height_m), Vector3d(last_m, 0.0, 0.0)}, floor_frame(from, along));
    }
  }

 private:
  std::string name_;
  Random random_;
  Scene& scene_;
  mesh::MeshBuilder& mesh_;
};

// Adds the doorway and the pillar of a section. Frame K: origin at the section's center, x along it, y to the right.
void add_fixtures(const CorridorConfig& c, const CorridorSection& section, const Eigen::Isometry3d& X_WK,
                  double width_m, WallBuilder& builder) {
  const double half_m = 0.5 * width_m, thin_m = 0.5 * kThicknessM, outer_m = half_m + thin_m;
  if (section.doorway_m > 0.0) {
    const double jamb_m = 0.5 * section.doorway_m;
    builder.begin("doorway");
    builder.build({Vector3d(-thin_m, -outer_m, -c.height_m), Vector3d(thin_m, -jamb_m, 0.0)}, X_WK);
    builder.build({Vector3d(-thin_m, jamb_m, -c.height_m), Vector3d(thin_m, outer_m, 0.0)}, X_WK);
    if (c.door_height_m < c.height_m) {
      builder.begin("lintel");
      builder.build({Vector3d(-thin_m, -jamb_m, -c.height_m), Vector3d(thin_m, jamb_m, -c.door_height_m)}, X_WK);
    }
  }
  if (section.obstacle_m != 0.0) {
    const double inner_m = half_m - std::abs(section.obstacle_m), side = section.obstacle_m > 0.0 ? 1.0 : -1.0;
    const double one_m = side * inner_m, other_m = side * outer_m, long_m = 0.5 * kPillarLengthM;
    builder.begin("pillar");
    builder.build(
        {Vector3d(-long_m, std::min(one_m, other_m), -c.height_m), Vector3d(long_m, std::max(one_m, other_m), 0.0)},
        X_WK);
  }
}

cv::Mat paint_paper(textures::WallPaper paper, int size_px, uint64_t seed) {
  return textures::paint_room_walls(paper, size_px, 1, seed).front();
}

TextureList corridor_textures(const CorridorConfig& c, uint64_t seed) {
  using textures::faded, textures::WallPaper;
  const int size_px = static_cast<int>(c.texture_size_px);
  const double wall = c.texture, floor = c.floor_texture;
  TextureList list(size_px);
  list.add([=] { return faded(textures::paint_brick_wall(size_px, derived_seed(seed, 0)), wall); });
  list.add([=] { return faded(paint_paper(WallPaper::plaster, size_px, derived_seed(seed, 1)), wall); });
  list.add([=] { return faded(paint_paper(WallPaper::damask, size_px, derived_seed(seed, 2)), wall); });
  list.add([=] { return faded(textures::paint_parquet(size_px, derived_seed(seed, 3)), floor); });
  list.add([=] { return faded(textures::paint_ceiling(size_px, derived_seed(seed, 4)), floor); });
  return list;
}

}  // namespace

Scene make_corridor(const CorridorConfig& written, uint64_t seed) {
  const CorridorConfig config = draw_corridor(written, seed);
  const CorridorPlan plan = plan_corridor(config, seed);
  Scene scene;
  scene.name = "corridor";
  scene.lights.ambient = 0.70f;
  scene.lights.sun = 0.30f;
  scene.textures = corridor_textures(config, derived_seed(seed, kCorridorImageStream));
  for (size_t k = 0; k < plan.lefts_NE.size(); ++k) {
    scene.bounds_NE_m.extend(plan.lefts_NE[k]);
    scene.bounds_NE_m.extend(plan.rights_NE[k]);
  }

  mesh::MeshBuilder mesh("opaque");
  const double reach_m = scene.bounds_NE_m.min().cwiseAbs().cwiseMax(scene.bounds_NE_m.max().cwiseAbs()).maxCoeff();
  mesh::add_ground(reach_m, {kFloor, textures::kRoomTileM}, mesh);
  WallBuilder builder(derived_seed(seed, kOffsetStream), scene, mesh);
  for (size_t k = 0; k < config.sections.size(); ++k) {
    const Vector2d from = plan.middles_NE[k], to = plan.middles_NE[k + 1], along = (to - from).normalized();
    const double width_m = 0.5 * ((plan.rights_NE[k] - plan.lefts_NE[k]).dot(to_the_right(along)) +
                                  (plan.rights_NE[k + 1] - plan.lefts_NE[k + 1]).dot(to_the_right(along)));
    add_fixtures(config, config.sections[k], floor_frame(0.5 * (from + to), along), width_m, builder);
  }
  builder.build_wall("left wall", plan.lefts_NE, config.height_m);
  builder.build_wall("right wall", {plan.rights_NE.rbegin(), plan.rights_NE.rend()}, config.height_m);
  builder.build_wall("end wall", {plan.rights_NE.front(), plan.lefts_NE.front()}, config.height_m);
  builder.build_wall("end wall", {plan.lefts_NE.back(), plan.rights_NE.back()}, config.height_m);

  if (config.ceiling) {
    const Vector2d low = scene.bounds_NE_m.min().array() - kThicknessM,
                   high = scene.bounds_NE_m.max().array() + kThicknessM;
    const Eigen::AlignedBox3d ceiling_W(Vector3d(low.x(), low.y(), -config.height_m - kThicknessM),
                                        Vector3d(high.x(), high.y(), -config.height_m));
    mesh.begin_instance("ceiling", SemanticClass::ceiling);
    mesh.begin_chunk(false);
    mesh::add_box(ceiling_W, Eigen::Isometry3d::Identity(), {kCeiling, textures::kRoomTileM}, mesh);
    scene.solids.push_back(mesh::solid_of("ceiling", ceiling_W));
  }
  scene.meshes.push_back(mesh.finish());
  return scene;
}

}  // namespace hedgehop::scenes::worlds
