#include "scenes/worlds/urban.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "scenes/mesh/mesh_builder.h"
#include "scenes/textures/city_textures.h"
#include "scenes/world_config.h"
#include "scenes/worlds/city_mesh.h"
#include "sim/fields/bounds.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes::worlds {

namespace {

// Streams of the scene's seed.
constexpr uint64_t kUrbanPlanStream = 0;
constexpr uint64_t kUrbanImageStream = 1;
constexpr uint64_t kGroundStream = 2;
constexpr uint64_t kBuildingStream = 3;
constexpr uint64_t kWearStream = 4;

}  // namespace

Scene make_urban(const UrbanConfig& config, uint64_t seed) {
  const UrbanPlan plan = plan_urban(config, derived_seed(seed, kUrbanPlanStream));
  require_texture_size(config.texture_size_px);
  textures::CityTextures city = textures::city_textures(static_cast<int>(config.texture_size_px),
                                                        derived_seed(seed, kUrbanImageStream), config.wear);

  Scene scene;
  scene.name = "urban";
  scene.has_ground = true;
  scene.lights.ambient = 0.62f;
  scene.lights.sun = 0.50f;
  scene.lights.to_sun_W = Eigen::Vector3f(0.35f, -0.55f, -0.76f).normalized();
  const double half = 0.5 * config.extent_m;
  scene.bounds_NE_m = {Eigen::Vector2d(-half, -half), Eigen::Vector2d(half, half)};

  mesh::MeshBuilder mesh("opaque");
  add_city_ground(plan, city, derived_seed(seed, kGroundStream), config.wear, mesh);
  for (const Building& building : plan.buildings) {
    Random random(derived_seed(derived_seed(seed, kBuildingStream), static_cast<uint64_t>(building.cell)));
    const std::string name = "building " + std::to_string(building.cell);
    mesh.begin_instance(name, SemanticClass::building);
    Random wear(derived_seed(derived_seed(seed, kWearStream), static_cast<uint64_t>(building.cell)));
    add_building(building, city, random, config.wear ? &wear : nullptr, mesh);
    for (const Eigen::AlignedBox3d& box_W : building.boxes_W) scene.solids.push_back(mesh::solid_of(name, box_W));
  }
  scene.meshes.push_back(mesh.finish());
  scene.textures = std::move(city.images);
  return scene;
}

namespace {

constexpr double kGrainM = 1.0 / 64.0;
constexpr int kPlacementTries = 64;
constexpr double kMinLotM = 3.0;
constexpr double kMaxCellsPerSide = 1000.0;

double snapped_up(double x_m) { return std::ceil(x_m / kGrainM) * kGrainM; }
double snapped_down(double x_m) { return std::floor(x_m / kGrainM) * kGrainM; }

void validate(const UrbanConfig& c) {
  fields::require_bounds(c);
  const double lot_m = c.pitch_m - c.street_min_width_m;
  require(lot_m >= kMinLotM, "pitch", c.pitch_m, "at least street_min_width + 3 m");
  require(c.extent_m >= c.pitch_m && c.extent_m <= kMaxCellsPerSide * c.pitch_m, "extent", c.extent_m,
          "from pitch to 1000 pitch");
  require(c.min_footprint <= c.max_footprint, "min_footprint", c.min_footprint, "at most max_footprint");
  require(c.min_footprint * lot_m >= 1.0, "min_footprint", c.min_footprint, "at least 1 m of the lot's side");
  require(c.max_height_m >= c.min_height_m, "max_height", c.max_height_m, "at least min_height");
}

// Draws footprints in the lot until one does not overlap a clearing.
std::optional<Eigen::AlignedBox2d> place_footprint(const UrbanConfig& c, const Eigen::AlignedBox2d& lot_NE,
                                                   Random& random) {
  for (int attempt = 0; attempt < kPlacementTries; ++attempt) {
    Eigen::Vector2d low, high;
    for (int axis = 0; axis < 2; ++axis) {
      const double lot = lot_NE.sizes()[axis];
      const double size = lot * uniform(random, c.min_footprint, c.max_footprint);
      const double play = 0.5 * c.jitter * (lot - size);
      const double center = lot_NE.center()[axis] + uniform(random, -play, play);
      low[axis] = snapped_up(std::max(center - 0.5 * size, lot_NE.min()[axis]));
      high[axis] = snapped_down(std::min(center + 0.5 * size, lot_NE.max()[axis]));
    }
    const Eigen::AlignedBox2d footprint_NE(low, high);
    const bool clear = std::all_of(c.keep_clear.begin(), c.keep_clear.end(), [&](const Clearing& clearing) {
      return footprint_NE.exteriorDistance(clearing.center_NE_m()) >= clearing.radius_m;
    });
    if (clear) return footprint_NE;
  }
  return std::nullopt;
}

Eigen::AlignedBox3d box_on(const Eigen::AlignedBox2d& plan_NE, double bottom_height_m, double top_height_m) {
  return {Eigen::Vector3d(plan_NE.min().x(), plan_NE.min().y(), -top_height_m),
          Eigen::Vector3d(plan_NE.max().x(), plan_NE.max().y(), -bottom_height_m)};
}

// Returns a rectangle of the given size at a random position within `below_NE`, away from its edges if there is space.
Eigen::AlignedBox2d inset(const Eigen::AlignedBox2d& below_NE, const Eigen::Vector2d& size_m, Random& random) {
  Eigen::Vector2d low, high;
  for (int axis = 0; axis < 2; ++axis) {
    const double play = below_NE.sizes()[axis] - size_m[axis];
    low[axis] = snapped_up(below_NE.min()[axis] + play * uniform(random, 0.15, 0.85));
    high[axis] = snapped_down(std::min(low[axis] + size_m[axis], below_NE.max()[axis]));
  }
  return {low, high};
}

// Stacks the boxes of one building: a base, possibly a tower, and a roof housing with probability 1/2 if it fits.
void stack_boxes(const UrbanConfig& c, const Eigen::AlignedBox2d& footprint_NE, Random& random, Building& building) {
  constexpr double kHousingHeightM = 2.5;
  constexpr double kMinTowerM = 5.0;
  const double rise = std::pow(uniform(random, 0.0, 1.0), 1.4);  // low buildings are more common
  const double height = snapped_down(c.min_height_m + (c.max_height_m - c.min_height_m) * rise);
  const bool wants_tower = chance(random, c.setback_share);
  const bool wants_housing = chance(random, 0.5);
  const double tower_start = snapped_up(c.min_height_m + (height - c.min_height_m) * uniform(random, 0.1, 0.6));
  const Eigen::Vector2d tower_size =
      footprint_NE.sizes() * uniform(random, 0.5, 0.8) - Eigen::Vector2d::Constant(2.0 * kGrainM);

  const bool housing = wants_housing && height - kHousingHeightM >= c.min_height_m;
  const double roof = std::max(housing ? height - kHousingHeightM : height, snapped_up(c.min_height_m));
  Eigen::AlignedBox2d top_NE = footprint_NE;
  if (wants_tower && roof - tower_start >= kMinTowerM && tower_size.minCoeff() >= kMinTowerM) {
    building.boxes_W.push_back(box_on(footprint_NE, 0.0, tower_start));
    top_NE = inset(footprint_NE, tower_size, random);
    building.boxes_W.push_back(box_on(top_NE, tower_start, roof));
  } else {
    building.boxes_W.push_back(box_on(footprint_NE, 0.0, roof));
  }
  const Eigen::Vector2d housing_size(uniform(random, 2.5, 4.5), uniform(random, 2.5, 4.5));
  if (housing && ((top_NE.sizes() - housing_size).array() >= 1.0).all()) {
    building.boxes_W.push_back(box_on(inset(top_NE, housing_size, random), roof, roof + kHousingHeightM));
    building.has_roof_housing = true;
  }
}

}  // namespace

UrbanPlan plan_urban(const UrbanConfig& config, uint64_t seed) {
  validate(config);
  UrbanPlan plan;
  plan.cells_per_side = static_cast<int>(std::floor(config.extent_m / config.pitch_m * (1.0 + 1e-12)));
  plan.pitch_m = config.pitch_m;
  plan.street_width_m = config.street_min_width_m;

  const Eigen::Vector2d half_street = Eigen::Vector2d::Constant(0.5 * config.street_min_width_m);
  for (int row = 0; row < plan.cells_per_side; ++row) {
    for (int column = 0; column < plan.cells_per_side; ++column) {
      const int cell = row * plan.cells_per_side + column;
      Random random(derived_seed(seed, static_cast<uint64_t>(cell)));
      if (!chance(random, config.occupancy)) continue;
      const Eigen::AlignedBox2d lot_NE(
          Eigen::Vector2d(plan.cell_edge_m(row), plan.cell_edge_m(column)) + half_street,
          Eigen::Vector2d(plan.cell_edge_m(row + 1), plan.cell_edge_m(column + 1)) - half_street);
      const auto footprint_NE = place_footprint(config, lot_NE, random);
      if (!footprint_NE) continue;
      Building building;
      building.cell = cell;
      stack_boxes(config, *footprint_NE, random, building);
      plan.buildings.push_back(std::move(building));
    }
  }
  return plan;
}

}  // namespace hedgehop::scenes::worlds
