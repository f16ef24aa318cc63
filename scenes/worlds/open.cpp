#include "scenes/worlds/open.h"

#include "scenes/mesh/bodies.h"
#include "scenes/textures/street_textures.h"
#include "sim/fields/bounds.h"

namespace hedgehop::scenes::worlds {

namespace {

constexpr uint64_t kOpenGrassStream = 0;  // of the scene's seed
constexpr double kOpenHalfM = 50.0;

}  // namespace

Scene make_open(const OpenConfig& config, uint64_t seed) {
  fields::require_bounds(config);
  require_texture_size(config.texture_size_px);
  const int size_px = static_cast<int>(config.texture_size_px);
  Scene scene;
  scene.name = "open";
  scene.textures = TextureList(size_px);
  const uint32_t grass = scene.textures.add([size_px, grass_seed = derived_seed(seed, kOpenGrassStream)] {
    return textures::paint_grass(size_px, grass_seed);
  });
  mesh::MeshBuilder mesh("opaque");
  mesh::add_ground(kOpenHalfM, {grass, textures::kGrassTileM}, mesh);
  scene.meshes.push_back(mesh.finish());
  return scene;
}

void set_bounds(Scene& scene) {
  const Eigen::Vector2d half_m(kOpenHalfM, kOpenHalfM);
  scene.bounds_NE_m = {Eigen::Vector2d(-half_m), half_m};
  for (const Solid& solid : scene.solids) {
    const Eigen::AlignedBox3d box_W = bounds_W(solid);
    scene.bounds_NE_m.extend(Eigen::AlignedBox2d(box_W.min().head<2>(), box_W.max().head<2>()));
  }
}

}  // namespace hedgehop::scenes::worlds
