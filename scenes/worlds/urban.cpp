#include "scenes/worlds/urban.h"

#include "scenes/mesh/building_mesh.h"
#include "scenes/mesh/mesh_builder.h"
#include "scenes/require.h"
#include "scenes/textures/city_textures.h"
#include "scenes/worlds/city_ground.h"
#include "scenes/worlds/urban_plan.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes::worlds {
namespace {

// Streams of the scene's seed.
constexpr uint64_t kUrbanPlanStream = 0;
constexpr uint64_t kUrbanImageStream = 1;
constexpr uint64_t kGroundStream = 2;
constexpr uint64_t kBuildingStream = 3;

}  // namespace

Scene make_urban(const UrbanConfig& config, uint64_t seed) {
  const UrbanPlan plan = plan_urban(config, derived_seed(seed, kUrbanPlanStream));
  require_texture_size(config.texture_size_px);
  textures::CityTextures city =
      textures::paint_city(static_cast<int>(config.texture_size_px), derived_seed(seed, kUrbanImageStream));

  Scene scene;
  scene.name = "urban";
  scene.has_ground = true;
  scene.lights.ambient = 0.62f;
  scene.lights.sun = 0.50f;
  scene.lights.to_sun_W = Eigen::Vector3f(0.35f, -0.55f, -0.76f).normalized();
  const double half = 0.5 * config.extent_m;
  scene.bounds_NE_m = {Eigen::Vector2d(-half, -half), Eigen::Vector2d(half, half)};

  mesh::MeshBuilder mesh("opaque");
  add_city_ground(plan, city, derived_seed(seed, kGroundStream), mesh);
  for (const Building& building : plan.buildings) {
    Random random(derived_seed(derived_seed(seed, kBuildingStream), static_cast<uint64_t>(building.cell)));
    mesh::add_building(building, city, random, mesh);
    for (const Eigen::AlignedBox3d& box_W : building.boxes_W) {
      scene.solids.push_back(mesh::solid_of("building " + std::to_string(building.cell), box_W));
    }
  }
  scene.meshes.push_back(mesh.finish());
  scene.textures = std::move(city.images);
  return scene;
}

}  // namespace hedgehop::scenes::worlds
