#include "scenes/map/map_trees.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <tuple>
#include <utility>

#include "scenes/map/tags.h"
#include "scenes/mesh/tree_mesh.h"
#include "scenes/textures/park_textures.h"

namespace hedgehop::scenes::map {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRowSpacingM = 8.0, kTreePlotM = 32.0;  // trees of a plot are culled together

MapTree tree_of(const std::string& name, const Tags& tags, const Vector2d& p_NE, Random& random,
                std::vector<std::string>& faults) {
  constexpr double kMinHeightM = 1.0, kMaxHeightM = 130.0, kMinCrownM = 0.5, kMaxCrownM = 40.0;
  const TagReader reader(name, tags, faults);
  const double height_m = reader.length_m("height", kMinHeightM, kMaxHeightM).value_or(uniform(random, 6.0, 11.0));
  const double crown_m = reader.length_m("diameter_crown", kMinCrownM, kMaxCrownM)
                             .value_or(std::max(kMinCrownM, uniform(random, 0.45, 0.65) * height_m));
  return {name, p_NE, height_m, 0.5 * crown_m};
}

std::tuple<int, int> plot_of(const MapTree& tree) {
  return {static_cast<int>(std::floor(tree.p_NE.x() / kTreePlotM)),
          static_cast<int>(std::floor(tree.p_NE.y() / kTreePlotM))};
}

/// Shares of a crown's radii: the extent of the octahedron that replaces it at a distance, and the maximum distance
/// between the octahedron and the lump. Surfaces of both lie between their insphere and their circumsphere.
struct FarCrown {
  double extent = 0.0, error = 0.0;
};

FarCrown far_crown(const std::vector<mesh::Polyhedron>& lumps) {
  double inner = 1.0;
  for (const mesh::Polyhedron& lump : lumps) {
    for (const auto& [a, b, c] : lump.faces) {
      const auto& p = lump.corners;
      inner = std::min(inner, (p[b] - p[a]).cross(p[c] - p[a]).normalized().dot(p[a]));
    }
  }
  // The octahedron reaches from extent / sqrt(3) to extent, a lump from `inner` to 1: equal distances on both sides.
  const double per_root3 = 1.0 / std::numbers::sqrt3, extent = (1.0 + inner) / (1.0 + per_root3);
  return {extent, extent - inner};
}

/// Adds the far detail of a tree: its crown as an octahedron, without a trunk.
void add_far_tree(const mesh::TreeShape& shape, const FarCrown& far, const mesh::Cover& leaves,
                  mesh::MeshBuilder& mesh) {
  const double half_m = 0.5 * (shape.height_m - shape.clear_height_m);
  const Vector3d middle_W = shape.foot_W - Vector3d(0.0, 0.0, shape.clear_height_m + half_m);
  const Vector3d radii_m(shape.crown_radius_m, shape.crown_radius_m, half_m);
  mesh::Polyhedron crown;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0})
      crown.corners.push_back(middle_W + far.extent * side * radii_m[axis] * Vector3d::Unit(axis));
  }
  crown.faces = {{1, 3, 5}, {3, 0, 5}, {0, 2, 5}, {2, 1, 5}, {3, 1, 4}, {0, 3, 4}, {2, 0, 4}, {1, 2, 4}};
  const size_t first = mesh.index_count();
  mesh::add_polyhedron(crown, mesh::Shading::smooth, leaves, mesh);
  mesh.move_to_far(first, 2.0 * std::max(far.error * radii_m.maxCoeff(), shape.trunk_radius_m));
}

}  // namespace

std::vector<MapTree> trees_of(const OsmObjects& objects, const LocalPlane& plane, uint64_t seed,
                              std::vector<std::string>& faults) {
  Random random(seed);
  std::vector<MapTree> trees;
  for (const OsmPoint& point : objects.trees)
    trees.push_back(tree_of(point.name, point.tags, plane.p_NE(point.place), random, faults));
  for (const OsmLine& row : objects.tree_rows) {
    double next_m = 0.0;  // of the next tree, from the point at hand
    for (size_t i = 0; i + 1 < row.points.size(); ++i) {
      const Vector2d from = plane.p_NE(row.points[i]), along = plane.p_NE(row.points[i + 1]) - from;
      const double length_m = along.norm();
      constexpr double kMaxLengthM = 20e3;
      if (!(length_m > 0.0)) continue;
      if (length_m > kMaxLengthM) {
        faults.push_back(row.name + ": points of it are more than 20 km apart");
        break;
      }
      for (; next_m <= length_m; next_m += kRowSpacingM)
        trees.push_back(tree_of(row.name, row.tags, from + next_m / length_m * along, random, faults));
      next_m -= length_m;
    }
  }
  return trees;
}

void add_map_trees(std::vector<MapTree> trees, const Ground& ground, const TownTextures& town, uint64_t seed,
                   mesh::MeshBuilder& mesh, std::vector<Solid>& solids, std::vector<std::string>& faults) {
  constexpr int kLumps = 6, kLumpCorners = 20;
  constexpr double kClearShare = 0.25, kMaxClearM = 2.5, kTrunkShare = 0.02;  // of the height
  std::ranges::stable_sort(trees, {}, plot_of);
  Random random(seed);
  std::vector<mesh::Polyhedron> lumps;
  for (int k = 0; k < kLumps; ++k) lumps.push_back(mesh::convex_lump(kLumpCorners, 0.15, random));
  const FarCrown far = far_crown(lumps);
  const MapTree* last = nullptr;
  for (const MapTree& tree : trees) {
    const std::optional<double> ground_m = ground.altitude_m(tree.p_NE);
    if (!ground_m) {
      faults.push_back(tree.name + ": left out, since the terrain has no height there");
      continue;
    }
    if (last == nullptr || plot_of(*last) != plot_of(tree)) mesh.begin_chunk(false);
    last = &tree;
    const Vector2d offset(uniform(random, 0.0, 1.0), uniform(random, 0.0, 1.0));
    const mesh::Cover leaves{town.leaves[static_cast<size_t>(uniform_index(random, 2))], textures::kLeafTileM, offset},
        bark{town.bark, textures::kBarkTileM, offset};
    const mesh::TreeShape shape{.foot_W = {tree.p_NE.x(), tree.p_NE.y(), -*ground_m},
                                .height_m = tree.height_m,
                                .clear_height_m = std::min(kClearShare * tree.height_m, kMaxClearM),
                                .crown_radius_m = tree.crown_radius_m,
                                .trunk_radius_m = std::min(kTrunkShare * tree.height_m, 0.5 * tree.crown_radius_m)};
    mesh.begin_instance(tree.name, SemanticClass::tree);
    std::ranges::move(mesh::add_tree(tree.name, shape, lumps, leaves, bark, random, mesh), std::back_inserter(solids));
    add_far_tree(shape, far, leaves, mesh);
  }
}

}  // namespace hedgehop::scenes::map
