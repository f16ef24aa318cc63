#include "scenes/worlds/wall.h"

#include <algorithm>
#include <cmath>

#include "scenes/mesh/bodies.h"
#include "scenes/textures/stone_textures.h"
#include "scenes/textures/street_textures.h"
#include "scenes/world_config.h"
#include "sim/fields/bounds.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes::worlds {
namespace {

constexpr uint64_t kWallGrassStream = 0, kWallStream = 1, kWallPlanStream = 2;  // of the scene's seed

// Throws if any seed could make the wall impossible.
void validate(const WallConfig& c) {
  fields::require_bounds(c);
  require_texture_size(c.texture_size_px);
  if (!c.opening) return;
  const WallOpening& o = *c.opening;
  const double largest = 1.0 + c.vary;
  require(largest * (o.bottom_m + o.height_m) <= c.height_m, "opening.bottom", o.bottom_m,
          "at most the height of the wall minus that of the opening, including variation");
  require(largest * (std::abs(o.middle_m) + 0.5 * o.width_m) <= 0.5 * c.width_m, "opening.middle", o.middle_m,
          "an opening inside the wall, including variation");
}

WallConfig draw_wall(const WallConfig& config, uint64_t seed) {
  WallConfig drawn = config;
  if (config.vary == 0.0) return drawn;
  Random random(derived_seed(seed, kWallPlanStream));
  const auto vary = [&](double& length_m) { length_m *= uniform(random, 1.0 - config.vary, 1.0 + config.vary); };
  vary(drawn.north_m);
  if (drawn.opening) {
    WallOpening& o = *drawn.opening;
    for (double* length_m : {&o.middle_m, &o.bottom_m, &o.width_m, &o.height_m}) vary(*length_m);
  }
  return drawn;
}

cv::Mat paint(WallConfig::Surface surface, int size_px, uint64_t seed) {
  switch (surface) {
    case WallConfig::Surface::clouded:
      return textures::paint_clouded_wall(size_px, seed);
    case WallConfig::Surface::blank:
      return textures::paint_blank(size_px, {0.72f, 0.71f, 0.69f});
    case WallConfig::Surface::brick:
      break;
  }
  return textures::paint_brick_wall(size_px, seed);
}

TextureList wall_textures(const WallConfig& config, uint64_t seed) {
  const int size_px = static_cast<int>(config.texture_size_px);
  const uint64_t grass_seed = derived_seed(seed, kWallGrassStream), wall_seed = derived_seed(seed, kWallStream);
  TextureList list(size_px);
  list.add([=] { return textures::paint_grass(size_px, grass_seed); });
  list.add([=, surface = config.surface] { return paint(surface, size_px, wall_seed); });
  return list;
}

}  // namespace

Scene make_wall(const WallConfig& written, uint64_t seed) {
  validate(written);
  const WallConfig config = draw_wall(written, seed);
  Scene scene;
  scene.name = "wall";
  // A low sun in the south lights the face toward the vehicle.
  scene.lights.to_sun_W = Eigen::Vector3f(-0.7f, -0.3f, -0.65f).normalized();
  scene.textures = wall_textures(config, seed);
  const double half_m = std::max(config.width_m, std::abs(config.north_m) + 20.0);
  scene.bounds_NE_m = {Eigen::Vector2d(-half_m, -half_m), Eigen::Vector2d(half_m, half_m)};
  mesh::MeshBuilder mesh("opaque");
  mesh::add_ground(half_m, {0, textures::kGrassTileM}, mesh);

  mesh.begin_instance("wall", SemanticClass::wall);
  const auto build = [&](double west_m, double east_m, double bottom_m, double top_m) {
    if (east_m <= west_m || top_m <= bottom_m) return;
    const Eigen::AlignedBox3d box_W(Eigen::Vector3d(config.north_m, west_m, -top_m),
                                    Eigen::Vector3d(config.north_m + config.thickness_m, east_m, -bottom_m));
    mesh.begin_chunk(bottom_m == 0.0);
    mesh::add_box(box_W, Eigen::Isometry3d::Identity(), {1, textures::kWallTileM}, mesh);
    scene.solids.push_back(mesh::solid_of("wall", box_W));
  };
  const double end_m = 0.5 * config.width_m;
  if (config.opening) {
    const WallOpening& o = *config.opening;
    const double west_m = o.middle_m - 0.5 * o.width_m, east_m = o.middle_m + 0.5 * o.width_m;
    build(-end_m, west_m, 0.0, config.height_m);
    build(east_m, end_m, 0.0, config.height_m);
    build(west_m, east_m, 0.0, o.bottom_m);
    build(west_m, east_m, o.bottom_m + o.height_m, config.height_m);
  } else {
    build(-end_m, end_m, 0.0, config.height_m);
  }
  scene.meshes.push_back(mesh.finish());
  return scene;
}

}  // namespace hedgehop::scenes::worlds
