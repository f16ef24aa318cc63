#include "scenes/worlds/tree_world.h"

#include <algorithm>

#include "scenes/mesh/ground.h"
#include "scenes/mesh/tree_mesh.h"
#include "scenes/require.h"
#include "scenes/textures/street_textures.h"
#include "sim/fields/bounds.h"

namespace hedgehop::scenes::worlds {
namespace {

// Streams of the scene's seed.
constexpr uint64_t kShapeStream = 0;
constexpr uint64_t kTreeImageStream = 1;

constexpr int kTreeLumps = 6, kLumpCorners = 42, kLobes = 30;

void validate(const TreeConfig& c) {
  fields::require_bounds(c);
  require(c.clear_height_m < c.height_m, "clear_height", c.clear_height_m, "less than the height");
  require(c.trunk_diameter_m <= c.crown_diameter_m, "trunk_diameter", c.trunk_diameter_m, "at most the crown's");
  require_texture_size(c.texture_size_px);
}

}  // namespace

Scene make_tree(const TreeConfig& config, uint64_t seed) {
  validate(config);
  const int size_px = static_cast<int>(config.texture_size_px);
  const uint64_t image_seed = derived_seed(seed, kTreeImageStream);
  Scene scene;
  scene.name = "tree";
  scene.textures = {textures::paint_grass(size_px, derived_seed(image_seed, 0)),
                    textures::paint_leaves(config.leaves, size_px, derived_seed(image_seed, 1)),
                    textures::paint_bark(size_px, derived_seed(image_seed, 2))};
  const Eigen::Vector2d foot_NE(config.north_m, config.east_m);
  const double around_m = std::max(40.0, 3.0 * config.crown_diameter_m);
  scene.bounds_NE_m = {Eigen::Vector2d(foot_NE.array() - around_m), Eigen::Vector2d(foot_NE.array() + around_m)};

  Random random(derived_seed(seed, kShapeStream));
  std::vector<mesh::Polyhedron> lumps;
  for (int k = 0; k < kTreeLumps; ++k) lumps.push_back(mesh::convex_lump(kLumpCorners, 0.18, random));
  mesh::MeshBuilder mesh("opaque");
  mesh::add_ground(around_m, {0, textures::kGrassTileM}, mesh);
  mesh.begin_chunk(false);
  const mesh::TreeShape shape{.foot_W = {config.north_m, config.east_m, 0.0},
                              .height_m = config.height_m,
                              .clear_height_m = config.clear_height_m,
                              .crown_radius_m = 0.5 * config.crown_diameter_m,
                              .trunk_radius_m = 0.5 * config.trunk_diameter_m,
                              .lobes = kLobes,
                              .trunk_sides = 16};
  scene.solids =
      mesh::add_tree("tree", shape, lumps, {1, textures::kLeafTileM}, {2, textures::kBarkTileM}, random, mesh);
  scene.meshes.push_back(mesh.finish());
  return scene;
}

}  // namespace hedgehop::scenes::worlds
