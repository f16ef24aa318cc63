#include "scenes/worlds/park.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "scenes/mesh/bodies.h"
#include "scenes/mesh/tree_mesh.h"
#include "scenes/textures/park_textures.h"
#include "scenes/textures/stone_textures.h"
#include "scenes/textures/street_textures.h"
#include "scenes/world_config.h"
#include "scenes/worlds/wear.h"
#include "sim/fields/bounds.h"

namespace hedgehop::scenes::worlds {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Streams of the scene's seed.
constexpr uint64_t kParkPlaceStream = 0;
constexpr uint64_t kParkImageStream = 1;
constexpr uint64_t kParkLumpStream = 2;
constexpr uint64_t kParkWearStream = 3;

constexpr double kRoadHalfM = 3.5, kParkedM = 4.9;  // vehicles are parked on the verge

void validate(const ParkConfig& c) {
  fields::require_bounds(c);
  require_texture_size(c.texture_size_px);
}

struct ParkDisc {
  Vector2d p_NE;
  double radius_m;
};

// Finds free positions in the plan.
class PlacementPlanner {
 public:
  PlacementPlanner(const ParkConfig& config, uint64_t seed) : config_(config), random_(seed) {}

  /// Returns a position next to the road for a disc of this radius or, if `parked`, a position on the verge.
  ParkDisc take(const char* field, double radius_m, bool parked) {
    constexpr int kTries = 3000;
    const double half_m = 0.5 * config_.extent_m - radius_m;
    for (int k = 0; k < kTries; ++k) {
      ParkDisc disc{{uniform(random_, -half_m, half_m), uniform(random_, -half_m, half_m)}, radius_m};
      if (parked) disc.p_NE.y() = chance(random_, 0.5) ? kParkedM : -kParkedM;
      if (!parked && std::abs(disc.p_NE.y()) - radius_m < kRoadHalfM) continue;
      const bool is_free = std::ranges::none_of(taken_, [&](const ParkDisc& other) {
        return (other.p_NE - disc.p_NE).norm() - other.radius_m - radius_m < config_.gap_m;
      });
      const bool is_clear = std::ranges::none_of(config_.keep_clear, [&](const Clearing& clearing) {
        return (clearing.center_NE_m() - disc.p_NE).norm() - radius_m < clearing.radius_m;
      });
      if (is_free && is_clear) return taken_.emplace_back(disc);
    }
    std::ostringstream line;
    line << field << ": no free position after " << taken_.size()
         << " objects; valid: fewer objects, a larger extent or a smaller gap";
    throw std::invalid_argument(line.str());
  }

  Random& random() { return random_; }

 private:
  const ParkConfig& config_;
  Random random_;
  std::vector<ParkDisc> taken_;
};

constexpr uint32_t kParkGrass = 0, kAsphalt = 1, kParkBark = 2, kRock = 3, kFirstParkLeaves = 4, kFirstPaint = 7;
constexpr int kParkLeaves = 3, kPaints = 3;
constexpr uint32_t kRoadRepairs = kFirstPaint + 2 * kPaints;
constexpr double kRoadInsetM = 0.3;  // of repairs, from the edges of a lane

TextureList park_textures(int size_px, uint64_t seed, bool wear) {
  using textures::Leaves, textures::paint_leaves;
  TextureList list(size_px);
  list.add([=] { return textures::paint_grass(size_px, derived_seed(seed, 0)); });
  list.add([=] { return textures::paint_asphalt_road(size_px, derived_seed(seed, 1)); });
  list.add([=] { return textures::paint_bark(size_px, derived_seed(seed, 2)); });
  list.add([=] { return textures::paint_rock(size_px, derived_seed(seed, 3)); });
  list.add([=] { return paint_leaves(Leaves::broad, size_px, derived_seed(seed, 4)); });
  list.add([=] { return paint_leaves(Leaves::autumn, size_px, derived_seed(seed, 5)); });
  list.add([=] { return paint_leaves(Leaves::broad, size_px, derived_seed(seed, 6)); });
  const textures::Color paints[kPaints] = {{0.62f, 0.08f, 0.08f}, {0.16f, 0.26f, 0.48f}, {0.80f, 0.80f, 0.78f}};
  for (uint64_t k = 0; k < kPaints; ++k) {
    const textures::Color paint = paints[k];
    list.add([=] { return textures::paint_vehicle_body(paint, size_px, derived_seed(seed, 10 + k)); });
    list.add([=] { return textures::paint_vehicle_cabin(paint, size_px, derived_seed(seed, 20 + k)); });
  }
  if (wear) list.add([=] { return textures::paint_repairs(size_px, derived_seed(seed, 7)); });
  return list;
}

// Builds the objects of the park, each in a chunk of its own.
class ParkBuilder {
 public:
  ParkBuilder(uint64_t seed, PlacementPlanner& planner, Scene& scene, mesh::MeshBuilder& mesh)
      : planner_(planner), scene_(scene), mesh_(mesh) {
    Random random(seed);
    for (int k = 0; k < 6; ++k) lumps_.push_back(mesh::convex_lump(36, 0.2, random));
  }

  void plant_tree(int64_t number) {
    const double radius_m = uniform(random(), 1.5, 3.0);
    const ParkDisc disc = planner_.take("trees", radius_m, false);
    const mesh::TreeShape shape{.foot_W = {disc.p_NE.x(), disc.p_NE.y(), 0.0},
                                .height_m = uniform(random(), 5.0, 9.0),
                                .clear_height_m = uniform(random(), 1.6, 2.4),
                                .crown_radius_m = radius_m,
                                .trunk_radius_m = uniform(random(), 0.12, 0.22),
                                .lobes = 9,
                                .trunk_sides = 10};
    const std::string name = "tree " + std::to_string(number);
    begin(name, SemanticClass::tree);
    const std::vector<Solid> solids =
        mesh::add_tree(name, shape, lumps_, leaves(), {kParkBark, textures::kBarkTileM}, random(), mesh_);
    scene_.solids.insert(scene_.solids.end(), solids.begin(), solids.end());
  }

  void plant_bush(int64_t number) {
    add_lump("bush " + std::to_string(number), SemanticClass::bush,
             planner_.take("bushes", uniform(random(), 0.5, 1.2), false), uniform(random(), 0.8, 1.4), leaves());
  }

  void place_rock(int64_t number) {
    const Vector2d offset(uniform(random(), 0.0, 1.0), uniform(random(), 0.0, 1.0));
    add_lump("rock " + std::to_string(number), SemanticClass::rock,
             planner_.take("rocks", uniform(random(), 0.4, 1.0), false), uniform(random(), 0.7, 1.2),
             {kRock, textures::kRockTileM, offset});
  }

  // Adds a car or, with probability 1/3, a van: a body on the ground and a cabin on top of it.
  void park_vehicle(int64_t number) {
    const bool is_van = chance(random(), 0.33);
    const double length_m = is_van ? 5.0 : 4.4, width_m = is_van ? 1.95 : 1.75, top_m = is_van ? 2.3 : 1.45;
    const ParkDisc disc = planner_.take("vehicles", 0.5 * std::hypot(length_m, width_m), true);
    const double turn_rad = uniform(random(), -0.08, 0.08) + (chance(random(), 0.5) ? std::numbers::pi : 0.0);
    const Eigen::Isometry3d X_WK =
        Eigen::Translation3d(disc.p_NE.x(), disc.p_NE.y(), 0.0) * Eigen::AngleAxisd(turn_rad, Vector3d::UnitZ());
    const double l = 0.5 * length_m, w = 0.5 * width_m, front = is_van ? 0.78 * l : 0.45 * l, body_m = 0.92;
    const uint32_t paint = kFirstPaint + 2 * static_cast<uint32_t>(uniform_index(random(), kPaints));
    const std::string name = (is_van ? "van " : "car ") + std::to_string(number);
    begin(name, SemanticClass::vehicle);
    add_part(name, {Vector3d(-l, -w, -body_m), Vector3d(l, w, 0.0)}, X_WK, paint);
    add_part(name, {Vector3d(is_van ? -l : -0.8 * l, -0.9 * w, -top_m), Vector3d(front, 0.9 * w, -body_m)}, X_WK,
             paint + 1);
  }

 private:
  Random& random() { return planner_.random(); }

  void begin(const std::string& name, SemanticClass kind) {
    mesh_.begin_chunk(false);
    mesh_.begin_instance(name, kind);
  }

  mesh::Cover leaves() {
    const Vector2d offset(uniform(random(), 0.0, 1.0), uniform(random(), 0.0, 1.0));
    return {kFirstParkLeaves + static_cast<uint32_t>(uniform_index(random(), kParkLeaves)), textures::kLeafTileM,
            offset};
  }

  // Adds a lump partly below the ground. `slender` is its height above the ground divided by its radius.
  void add_lump(const std::string& name, SemanticClass kind, const ParkDisc& disc, double slender,
                const mesh::Cover& cover) {
    const mesh::Polyhedron& lump =
        lumps_[static_cast<size_t>(uniform_index(random(), static_cast<int>(lumps_.size())))];
    const double height_m = slender * disc.radius_m;
    const Eigen::Affine3d place = Eigen::Translation3d(disc.p_NE.x(), disc.p_NE.y(), -0.3 * height_m) *
                                  Eigen::Scaling(disc.radius_m, disc.radius_m, 0.8 * height_m) *
                                  Eigen::AngleAxisd(uniform(random(), 0.0, 6.0), Vector3d::UnitZ());
    const mesh::Polyhedron placed = mesh::moved(place, lump);
    begin(name, kind);
    mesh::add_polyhedron(placed, mesh::Shading::smooth, cover, mesh_);
    scene_.solids.push_back(mesh::solid_of(name, placed));
  }

  void add_part(const std::string& name, const Eigen::AlignedBox3d& box_K, const Eigen::Isometry3d& X_WK,
                uint32_t image) {
    mesh::add_box(box_K, X_WK, {image, textures::kVehicleTileM}, mesh_);
    scene_.solids.push_back(mesh::solid_of(name, box_K, X_WK));
  }

  PlacementPlanner& planner_;
  Scene& scene_;
  mesh::MeshBuilder& mesh_;
  std::vector<mesh::Polyhedron> lumps_;
};

}  // namespace

Scene make_park(const ParkConfig& config, uint64_t seed) {
  validate(config);
  Scene scene;
  scene.name = "park";
  scene.textures =
      park_textures(static_cast<int>(config.texture_size_px), derived_seed(seed, kParkImageStream), config.wear);
  const double half_m = 0.5 * config.extent_m;
  scene.bounds_NE_m = {Vector2d(-half_m, -half_m), Vector2d(half_m, half_m)};
  mesh::MeshBuilder mesh("opaque");
  Wear repairs{{kAsphalt}, kRoadRepairs, textures::kGrassTileM, Random(derived_seed(seed, kParkWearStream))};
  mesh::add_ground(
      {-half_m, -0.5 * half_m, 0.0, 0.5 * half_m, half_m}, {-half_m, -kRoadHalfM, 0.0, kRoadHalfM, half_m},
      [&](const Vector2d& middle_NE) {
        const bool is_road = std::abs(middle_NE.y()) < kRoadHalfM;
        if (!is_road) return mesh::GroundCell{{kParkGrass, textures::kGrassTileM}, false};
        mesh::GroundCell road{{kAsphalt, textures::kAsphaltTileM}, true};
        if (config.wear && std::abs(middle_NE.x()) < half_m) {
          road.add = [&](const mesh::TexturedPanel& panel, const mesh::ImageArea& area) {
            add_worn(panel, area, kRoadInsetM, repairs, mesh);
          };
        }
        return road;
      },
      mesh);

  // Large objects first, because they are the hardest to place.
  PlacementPlanner planner(config, derived_seed(seed, kParkPlaceStream));
  ParkBuilder builder(derived_seed(seed, kParkLumpStream), planner, scene, mesh);
  for (int64_t k = 1; k <= config.vehicles; ++k) builder.park_vehicle(k);
  for (int64_t k = 1; k <= config.trees; ++k) builder.plant_tree(k);
  for (int64_t k = 1; k <= config.bushes; ++k) builder.plant_bush(k);
  for (int64_t k = 1; k <= config.rocks; ++k) builder.place_rock(k);
  scene.meshes.push_back(mesh.finish());
  return scene;
}

}  // namespace hedgehop::scenes::worlds
