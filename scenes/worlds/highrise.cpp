#include "scenes/worlds/highrise.h"

#include <algorithm>
#include <limits>

#include "scenes/mesh/bodies.h"
#include "scenes/textures/facade_textures.h"
#include "scenes/textures/stone_textures.h"
#include "scenes/textures/street_textures.h"
#include "scenes/world_config.h"
#include "sim/fields/bounds.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes::worlds {
namespace {

using Eigen::Vector3d;

// A block, with a pyramid on top if `spire_m` is above 0.
struct Tower {
  double north_m, east_m, side_north_m, side_east_m, height_m, spire_m;

  Eigen::AlignedBox3d box_W() const {
    const Vector3d middle(north_m, east_m, 0.0), half(0.5 * side_north_m, 0.5 * side_east_m, 0.0);
    return {Vector3d(middle - half - Vector3d(0.0, 0.0, height_m)), Vector3d(middle + half)};
  }
  Vector3d top_W() const { return {north_m, east_m, -height_m - spire_m}; }
  double shortest_edge_m() const {
    const double slant_m = (top_W() - box_W().min()).norm();
    return std::min({side_north_m, side_east_m, height_m, spire_m > 0.0 ? slant_m : height_m});
  }
};

constexpr uint64_t kTowerStream = 5;  // of the scene's seed; the images are streams 0 to 4

// At scale 1, m.
constexpr double kMaxHeightM = 40.0, kMinGapM = 4.0, kMaxMoveM = 12.0;

// Returns the minimum gap between two footprints along north or east.
double min_gap_m(const std::vector<Tower>& towers) {
  double min_m = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < towers.size(); ++i) {
    for (size_t k = 0; k < i; ++k) {
      const Tower &a = towers[i], &b = towers[k];
      const double north_m = std::abs(a.north_m - b.north_m) - 0.5 * (a.side_north_m + b.side_north_m);
      const double east_m = std::abs(a.east_m - b.east_m) - 0.5 * (a.side_east_m + b.side_east_m);
      min_m = std::min(min_m, std::max(north_m, east_m));
    }
  }
  return min_m;
}

// Draws a tower near a plain one, inside `extent_W`, so that a camera that sees the plain skyline sees the varied one.
Tower draw_tower(const Tower& plain, const Eigen::AlignedBox3d& extent_W, double vary, Random& random) {
  const auto resized = [&](double length_m) { return length_m * uniform(random, 1.0 - vary, 1.0 + vary); };
  const auto moved = [&](double middle_m, double side_m, int axis) {
    const double reach_m = vary * kMaxMoveM;
    const double low_m = std::max(middle_m - reach_m, extent_W.min()[axis] + 0.5 * side_m);
    const double high_m = std::min(middle_m + reach_m, extent_W.max()[axis] - 0.5 * side_m);
    return uniform(random, low_m, high_m);
  };
  // One statement per draw, because the order of evaluation of arguments is unspecified.
  Tower tower = plain;
  tower.side_north_m = resized(plain.side_north_m);
  tower.side_east_m = resized(plain.side_east_m);
  tower.height_m = resized(plain.height_m);
  tower.spire_m = resized(plain.spire_m);
  const double lower = std::min(1.0, kMaxHeightM / (tower.height_m + tower.spire_m));
  tower.height_m *= lower;
  tower.spire_m *= lower;
  tower.north_m = moved(plain.north_m, tower.side_north_m, 0);
  tower.east_m = moved(plain.east_m, tower.side_east_m, 1);
  return tower;
}

// Draws skylines until all towers of one are far enough apart.
std::vector<Tower> draw_skyline(const std::vector<Tower>& plain, double vary, uint64_t seed) {
  constexpr int kTries = 1000;  // at least a seventh of which succeed
  Eigen::AlignedBox3d extent_W;
  for (const Tower& tower : plain) extent_W.extend(tower.box_W());
  Random random(derived_seed(seed, kTowerStream));
  for (int attempt = 0; attempt < kTries; ++attempt) {
    std::vector<Tower> drawn;
    for (const Tower& tower : plain) drawn.push_back(draw_tower(tower, extent_W, vary, random));
    if (min_gap_m(drawn) >= kMinGapM) return drawn;
  }
  return plain;
}

std::vector<Tower> towers(const HighriseConfig& config, uint64_t seed) {
  std::vector<Tower> towers = {
      {6, -18, 12, 10, 34, 0}, {-8, -4, 9, 9, 22, 6}, {12, 2, 8, 10, 30, 10}, {-4, 18, 11, 9, 26, 7}};
  if (config.layout == HighriseConfig::Layout::cube) {
    towers = {{0, 0, 18, 18, 18, 0}};
  } else if (config.vary > 0.0) {
    towers = draw_skyline(towers, config.vary, seed);
  }
  for (Tower& t : towers) {
    for (double* length : {&t.north_m, &t.east_m, &t.side_north_m, &t.side_east_m, &t.height_m, &t.spire_m})
      *length *= config.scale;
  }
  return towers;
}

// Returns the corners of a box: those of the roof, then those of the base, both clockwise from the north-west.
std::vector<Vector3d> box_corners(const Eigen::AlignedBox3d& box) {
  std::vector<Vector3d> corners;
  for (const double z : {box.min().z(), box.max().z()}) {
    corners.emplace_back(box.max().x(), box.min().y(), z);
    corners.emplace_back(box.max().x(), box.max().y(), z);
    corners.emplace_back(box.min().x(), box.max().y(), z);
    corners.emplace_back(box.min().x(), box.min().y(), z);
  }
  return corners;
}

// Returns the roof of a tower with a spire: four faces that meet at the top.
mesh::Polyhedron spire_of(const Tower& tower) {
  mesh::Polyhedron spire;
  spire.corners = box_corners(tower.box_W());
  spire.corners.resize(4);
  spire.corners.push_back(tower.top_W());
  spire.faces = {{0, 4, 1}, {1, 4, 2}, {2, 4, 3}, {3, 4, 0}};
  return spire;
}

// Returns the tower with its spire as a closed convex body.
mesh::Polyhedron hull_of(const Tower& tower) {
  mesh::Polyhedron hull;
  hull.corners = box_corners(tower.box_W());
  hull.corners.push_back(tower.top_W());
  hull.faces = {{0, 8, 1}, {1, 8, 2}, {2, 8, 3}, {3, 8, 0}, {4, 5, 6}, {4, 6, 7}};
  for (uint32_t k = 0; k < 4; ++k) {
    const uint32_t next = (k + 1) % 4;
    hull.faces.push_back({k, next, next + 4});
    hull.faces.push_back({k, next + 4, k + 4});
  }
  return hull;
}

constexpr uint32_t kTowerGrass = 0, kTowerRoof = 1, kFirstTowerWall = 2;

TextureList highrise_textures(const HighriseConfig& config, uint64_t seed) {
  const int size_px = static_cast<int>(config.texture_size_px);
  const bool plain_walls = config.walls == HighriseConfig::Walls::plain;
  TextureList list(size_px);
  list.add([=] { return textures::paint_grass(size_px, derived_seed(seed, 0)); });
  list.add([=] { return textures::paint_blank(size_px, {0.62f, 0.30f, 0.24f}); });
  const cv::Vec3f plain[] = {
      {0.86f, 0.84f, 0.80f}, {0.80f, 0.72f, 0.58f}, {0.66f, 0.70f, 0.76f}, {0.90f, 0.88f, 0.86f}};
  for (size_t k = 0; k < 4; ++k) {
    const cv::Vec3f color = plain[k];
    list.add([=] {
      if (plain_walls) return textures::paint_blank(size_px, color);
      const textures::FacadeStyle& style = textures::facade_styles()[2 * k + 1];
      return textures::paint_facades(style, size_px, 1, derived_seed(seed, k + 1)).front();
    });
  }
  return list;
}

}  // namespace

std::vector<Eigen::Vector3d> highrise_corners(const HighriseConfig& config, uint64_t seed) {
  std::vector<Vector3d> corners;
  for (const Tower& tower : towers(config, seed)) {
    for (const Vector3d& corner : box_corners(tower.box_W())) corners.push_back(corner);
    if (tower.spire_m > 0.0) corners.push_back(tower.top_W());
  }
  return corners;
}

Scene make_highrise(const HighriseConfig& config, uint64_t seed) {
  fields::require_bounds(config);
  require_texture_size(config.texture_size_px);
  Scene scene;
  scene.name = "highrise";
  scene.textures = highrise_textures(config, seed);
  const double half_m = 60.0 * config.scale;
  scene.bounds_NE_m = {Eigen::Vector2d(-half_m, -half_m), Eigen::Vector2d(half_m, half_m)};
  mesh::MeshBuilder mesh("opaque");
  mesh::add_ground(half_m, {kTowerGrass, textures::kGrassTileM}, mesh);
  uint32_t wall = kFirstTowerWall;
  for (const Tower& tower : towers(config, seed)) {
    const std::string name = "tower " + std::to_string(wall - kFirstTowerWall + 1);
    const Eigen::AlignedBox3d box_W = tower.box_W();
    mesh.begin_instance(name, SemanticClass::building);
    mesh.begin_chunk(true);
    for (const mesh::TexturedPanel& panel : mesh::side_panels(box_W)) {
      mesh.add_tiled(panel, textures::FacadeStyle::kTileM, {0.0, -tower.height_m / textures::FacadeStyle::kTileM},
                     wall);
    }
    if (tower.spire_m > 0.0) {
      mesh.begin_chunk(false);
      mesh::add_polyhedron(spire_of(tower), mesh::Shading::flat, {kTowerRoof, textures::kRockTileM}, mesh);
      scene.solids.push_back(mesh::solid_of(name, hull_of(tower)));
    } else {
      mesh.add_tiled(mesh::top_panel(box_W), textures::kRockTileM, Eigen::Vector2d::Zero(), kTowerRoof);
      scene.solids.push_back(mesh::solid_of(name, box_W));
    }
    scene.shortest_edge_m = std::min(scene.shortest_edge_m, tower.shortest_edge_m());
    ++wall;
  }
  scene.corners_W = highrise_corners(config, seed);
  scene.meshes.push_back(mesh.finish());
  return scene;
}

}  // namespace hedgehop::scenes::worlds
