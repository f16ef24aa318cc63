#include "scenes/worlds/balloon.h"

#include "scenes/additions.h"
#include "scenes/mesh/bodies.h"
#include "scenes/textures/stone_textures.h"
#include "scenes/textures/street_textures.h"
#include "scenes/world_config.h"
#include "sim/fields/bounds.h"

namespace hedgehop::scenes::worlds {
namespace {

constexpr uint64_t kBalloonImageStream = 0, kMoverStream = 1;  // of the scene's seed

constexpr double kMarkerRadiusM = 0.12, kMarkerHeightM = 0.45, kMarkerEastM = 1.0;

}  // namespace

Scene make_balloon(const BalloonConfig& config, uint64_t seed) {
  fields::require_bounds(config);
  require_texture_size(config.texture_size_px);
  const int size_px = static_cast<int>(config.texture_size_px);
  const uint64_t grass_seed = derived_seed(seed, kBalloonImageStream);
  Scene scene;
  scene.name = "balloon";
  scene.textures = TextureList(size_px);
  const uint32_t grass = scene.textures.add([=] { return textures::paint_grass(size_px, grass_seed); });
  const uint32_t marking = scene.textures.add([=] { return textures::paint_blank(size_px, {0.90f, 0.42f, 0.10f}); });
  constexpr double kHalfM = 30.0;
  scene.bounds_NE_m = {Eigen::Vector2d(-kHalfM, -kHalfM), Eigen::Vector2d(kHalfM, kHalfM)};

  mesh::MeshBuilder mesh("opaque");
  mesh::add_ground(kHalfM, {grass, textures::kGrassTileM}, mesh);
  for (int64_t k = 0; k < config.markers; ++k) {
    const double north_m = static_cast<double>(k + 1) * config.marker_spacing_m;
    const mesh::Post marker{{north_m, kMarkerEastM, 0.0}, kMarkerRadiusM, kMarkerHeightM};
    const std::string name = "marker " + std::to_string(k + 1);
    mesh.begin_instance(name, SemanticClass::pole);
    mesh.begin_chunk(false);
    mesh::add_post(marker, 12, {marking, 1.0}, mesh);
    scene.solids.push_back(mesh::solid_of(name, marker));
  }
  scene.meshes.push_back(mesh.finish());
  add_movers({{.name = "balloon",
               .shape = MoverConfig::Shape::balloon,
               .radius_m = config.radius_m,
               .height_m = config.height_m,
               .motion = config.motion}},
             derived_seed(seed, kMoverStream), scene);
  return scene;
}

}  // namespace hedgehop::scenes::worlds
