#include "scenes/worlds/trees.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "scenes/mesh/bodies.h"
#include "scenes/mesh/tree_mesh.h"
#include "scenes/textures/park_textures.h"
#include "scenes/textures/street_textures.h"
#include "scenes/world_config.h"
#include "sim/fields/bounds.h"
#include "sim/fields/invalid_field.h"

namespace hedgehop::scenes::worlds {

namespace {

// Streams of the scene's seed.
constexpr uint64_t kShapeStream = 0;
constexpr uint64_t kTreeImageStream = 1;

constexpr int kTreeLumps = 6, kLumpCorners = 42, kLobes = 30;

void validate(const TreeConfig& c) {
  fields::require_bounds(c);
  require(c.clear_height_m < c.height_m, "clear_height", c.clear_height_m, "less than the height");
  require(c.trunk_diameter_m <= c.crown_diameter_m, "trunk_diameter", c.trunk_diameter_m,
          "at most the crown's diameter");
  require_texture_size(c.texture_size_px);
}

TextureList tree_textures(textures::Leaves leaves, int size_px, uint64_t seed) {
  TextureList list(size_px);
  list.add([=] { return textures::paint_grass(size_px, derived_seed(seed, 0)); });
  list.add([=] { return textures::paint_leaves(leaves, size_px, derived_seed(seed, 1)); });
  list.add([=] { return textures::paint_bark(size_px, derived_seed(seed, 2)); });
  return list;
}

}  // namespace

Scene make_tree(const TreeConfig& config, uint64_t seed) {
  validate(config);
  Scene scene;
  scene.name = "tree";
  scene.textures =
      tree_textures(config.leaves, static_cast<int>(config.texture_size_px), derived_seed(seed, kTreeImageStream));
  const Eigen::Vector2d foot_NE(config.north_m, config.east_m);
  const double around_m = std::max(40.0, 3.0 * config.crown_diameter_m);
  scene.bounds_NE_m = {Eigen::Vector2d(foot_NE.array() - around_m), Eigen::Vector2d(foot_NE.array() + around_m)};

  Random random(derived_seed(seed, kShapeStream));
  std::vector<mesh::Polyhedron> lumps;
  for (int k = 0; k < kTreeLumps; ++k) lumps.push_back(mesh::convex_lump(kLumpCorners, 0.18, random));
  mesh::MeshBuilder mesh("opaque");
  mesh::add_ground(around_m, {0, textures::kGrassTileM}, mesh);
  mesh.begin_instance("tree", SemanticClass::tree);
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

namespace {

// Streams of the scene's seed.
constexpr uint64_t kForestPlaceStream = 0;
constexpr uint64_t kForestImageStream = 1;
constexpr uint64_t kForestLumpStream = 2;
constexpr uint64_t kTreeStream = 3;

constexpr int kLumps = 12;  // per level of detail

// Trees within this distance of the origin have about 60 triangles, the others 15, so that a view of ten thousand trees
// is cheap to draw. Levels of detail that depend on the viewer's distance must not be visible (FarDetail). The solids
// of a tree have the corners of its mesh.
constexpr double kDetailedM = 45.0;
constexpr int kCorners = 26, kFewCorners = 6;
constexpr int kTrunkSides = 6, kFewTrunkSides = 3;

// Forests with more trees have far details, because the trunks of distant trees are thinner than a pixel.
constexpr int64_t kWideForest = 1000;

// Returns a lump with its lower half flattened, scaled back to its full height: crowns are widest below mid-height.
mesh::Polyhedron crown(int corners, double roughness, Random& random) {
  constexpr double kPressed = 0.45, kMiddle = 0.5 * (kPressed - 1.0), kHalf = 0.5 * (kPressed + 1.0);
  std::vector<Eigen::Vector3d> points = mesh::convex_lump(corners, roughness, random).corners;
  for (Eigen::Vector3d& p : points) p.z() = ((p.z() > 0.0 ? kPressed : 1.0) * p.z() - kMiddle) / kHalf;
  return mesh::convex_hull(points);
}

void require_ordered(const char* field, double low, double high) {
  require(low <= high, field, low, "at most its max_...");
}

void validate(const ForestConfig& c) {
  fields::require_bounds(c);
  require_ordered("min_height", c.min_height_m, c.max_height_m);
  require_ordered("min_crown_diameter", c.min_crown_diameter_m, c.max_crown_diameter_m);
  require_ordered("min_trunk_diameter", c.min_trunk_diameter_m, c.max_trunk_diameter_m);
  require(c.max_trunk_diameter_m <= c.min_crown_diameter_m, "max_trunk_diameter", c.max_trunk_diameter_m,
          "at most min_crown_diameter");
  require(c.clear_height_m < c.min_height_m, "clear_height", c.clear_height_m, "less than min_height");
  require_texture_size(c.texture_size_px);
}

struct TreeSite {
  Eigen::Vector2d p_NE;
  double crown_radius_m;
};

// The sites so far in a grid whose cells are too small for two sites.
class SiteGrid {
 public:
  SiteGrid(double extent_m, double spacing_m)
      : half_m_(0.5 * extent_m),
        spacing_m_(spacing_m),
        cell_m_(spacing_m / std::sqrt(2.0)),
        side_(static_cast<int>(std::ceil(extent_m / cell_m_))),
        cells_(static_cast<size_t>(side_) * static_cast<size_t>(side_), -1) {}

  /// Adds a site and returns true unless another site is within the spacing.
  bool take(const Eigen::Vector2d& p_NE, std::vector<TreeSite>& places, double crown_radius_m) {
    const Eigen::Array2i at = ((p_NE.array() + half_m_) / cell_m_).cast<int>().min(side_ - 1);
    const Eigen::Array2i low = (at - 2).max(0), high = (at + 2).min(side_ - 1);
    for (int i = low.x(); i <= high.x(); ++i) {
      for (int j = low.y(); j <= high.y(); ++j) {
        const int other = cells_[index(i, j)];
        if (other >= 0 && (places[static_cast<size_t>(other)].p_NE - p_NE).norm() < spacing_m_) return false;
      }
    }
    cells_[index(at.x(), at.y())] = static_cast<int>(places.size());
    places.push_back({p_NE, crown_radius_m});
    return true;
  }

 private:
  size_t index(int i, int j) const {
    return static_cast<size_t>(i) * static_cast<size_t>(side_) + static_cast<size_t>(j);
  }

  double half_m_, spacing_m_, cell_m_;
  int side_;
  std::vector<int> cells_;
};

// Dart throwing: draws random positions until the required number of trees is placed.
std::vector<TreeSite> place_trees(const ForestConfig& c, Random& random) {
  constexpr int64_t kDartsPerTree = 300;
  const double half_m = 0.5 * c.extent_m();
  SiteGrid grid(c.extent_m(), c.spacing_m);
  std::vector<TreeSite> places;
  const auto wanted = static_cast<size_t>(c.trees);
  for (int64_t dart = 0; places.size() < wanted && dart < kDartsPerTree * c.trees; ++dart) {
    const Eigen::Vector2d p_NE(uniform(random, -half_m, half_m), uniform(random, -half_m, half_m));
    const double crown_radius_m = 0.5 * uniform(random, c.min_crown_diameter_m, c.max_crown_diameter_m);
    const bool is_clear = std::ranges::none_of(c.keep_clear, [&](const Clearing& clearing) {
      return (clearing.center_NE_m() - p_NE).norm() - crown_radius_m < clearing.radius_m;
    });
    if (is_clear) grid.take(p_NE, places, crown_radius_m);
  }
  if (places.size() < wanted) {
    std::ostringstream line;
    line << wanted << "; valid: at most " << places.size() << ", the number that fits with spacing " << c.spacing_m
         << " m and these clearings";
    throw fields::InvalidField("trees", line.str());
  }
  return places;
}

// Distant trees are culled in plots with sides of this length, near ones individually.
constexpr double kPlotM = 16.0;

bool is_detailed(const TreeSite& place) { return place.p_NE.norm() < kDetailedM; }

// Returns the index of a tree's plot, row by row; -1 for a near tree.
int64_t plot(const TreeSite& place) {
  constexpr int64_t kPerRow = 1 << 20;
  const Eigen::Array2d at = (place.p_NE.array() / kPlotM).floor() + 0.5 * kPerRow;
  return is_detailed(place) ? -1 : static_cast<int64_t>(at.x()) * kPerRow + static_cast<int64_t>(at.y());
}

constexpr uint32_t kGrass = 0, kFirstLeaves = 1, kFirstBark = 4;
constexpr int kLeaves = 3, kBarks = 2;

TextureList forest_textures(int size_px, uint64_t seed) {
  using textures::Leaves, textures::paint_leaves;
  TextureList list(size_px);
  list.add([=] { return textures::paint_grass(size_px, derived_seed(seed, 0)); });
  list.add([=] { return paint_leaves(Leaves::broad, size_px, derived_seed(seed, 1)); });
  list.add([=] { return paint_leaves(Leaves::needles, size_px, derived_seed(seed, 2)); });
  list.add([=] { return paint_leaves(Leaves::broad, size_px, derived_seed(seed, 3)); });
  list.add([=] { return textures::paint_bark(size_px, derived_seed(seed, 4)); });
  list.add([=] { return textures::paint_bark(size_px, derived_seed(seed, 5)); });
  return list;
}

}  // namespace

double ForestConfig::extent_m() const { return spacing_m * std::sqrt(2.0 * static_cast<double>(trees)); }

Scene make_forest(const ForestConfig& config, uint64_t seed) {
  validate(config);
  Random place_random(derived_seed(seed, kForestPlaceStream)), lump_random(derived_seed(seed, kForestLumpStream));
  std::vector<TreeSite> places = place_trees(config, place_random);
  std::ranges::stable_sort(places, {}, plot);
  std::vector<mesh::Polyhedron> lumps, coarse_lumps;
  for (int k = 0; k < kLumps; ++k) {
    lumps.push_back(crown(kCorners, 0.22, lump_random));
    coarse_lumps.push_back(crown(kFewCorners, 0.1, lump_random));
  }

  Scene scene;
  scene.name = "forest";
  scene.textures = forest_textures(static_cast<int>(config.texture_size_px), derived_seed(seed, kForestImageStream));
  const double half_m = 0.5 * config.extent_m();
  scene.bounds_NE_m = {Eigen::Vector2d(-half_m, -half_m), Eigen::Vector2d(half_m, half_m)};
  mesh::MeshBuilder mesh("opaque");
  mesh::add_ground(half_m, {kGrass, textures::kGrassTileM}, mesh);

  const uint64_t tree_seed = derived_seed(seed, kTreeStream);
  for (size_t k = 0; k < places.size(); ++k) {
    Random random(derived_seed(tree_seed, k));
    const Eigen::Vector2d offset(uniform(random, 0.0, 1.0), uniform(random, 0.0, 1.0));
    const mesh::Cover leaves{kFirstLeaves + static_cast<uint32_t>(uniform_index(random, kLeaves)), textures::kLeafTileM,
                             offset};
    const mesh::Cover bark{kFirstBark + static_cast<uint32_t>(uniform_index(random, kBarks)), textures::kBarkTileM,
                           offset};
    const bool detailed = is_detailed(places[k]);
    if (detailed || k == 0 || plot(places[k]) != plot(places[k - 1])) mesh.begin_chunk(false);
    const mesh::TreeShape shape{
        .foot_W = {places[k].p_NE.x(), places[k].p_NE.y(), 0.0},
        .height_m = uniform(random, config.min_height_m, config.max_height_m),
        .clear_height_m = config.clear_height_m,
        .crown_radius_m = places[k].crown_radius_m,
        .trunk_radius_m = 0.5 * uniform(random, config.min_trunk_diameter_m, config.max_trunk_diameter_m),
        .trunk_sides = detailed ? kTrunkSides : kFewTrunkSides,
        .thins_out = config.trees > kWideForest,
    };
    const std::string name = "tree " + std::to_string(k + 1);
    mesh.begin_instance(name, SemanticClass::tree);
    std::vector<Solid> solids =
        mesh::add_tree(name, shape, detailed ? lumps : coarse_lumps, leaves, bark, random, mesh);
    std::ranges::move(solids, std::back_inserter(scene.solids));
  }
  scene.meshes.push_back(mesh.finish());
  return scene;
}

}  // namespace hedgehop::scenes::worlds
