#include "scenes/mesh/tree_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hedgehop::scenes::mesh {
namespace {

using Eigen::Vector3d;

Eigen::Affine3d lump_to_world(const Vector3d& center_W, const Vector3d& radii_m, Random& random) {
  const double turn_rad = uniform(random, 0.0, 2.0 * std::numbers::pi);
  return Eigen::Translation3d(center_W) * Eigen::Scaling(radii_m) * Eigen::AngleAxisd(turn_rad, Vector3d::UnitZ());
}

}  // namespace

std::vector<Solid> add_tree(const std::string& name, const TreeShape& shape, std::span<const Polyhedron> lumps,
                            const Cover& leaves, const Cover& bark, Random& random, MeshBuilder& mesh) {
  const double crown_half_m = 0.5 * (shape.height_m - shape.clear_height_m);
  const Vector3d crown_radii(shape.crown_radius_m, shape.crown_radius_m, crown_half_m);
  const Vector3d crown_center_W = shape.foot_W - Vector3d(0.0, 0.0, shape.clear_height_m + crown_half_m);

  const Post trunk{shape.foot_W, shape.trunk_radius_m, shape.clear_height_m + crown_half_m};
  add_post(trunk, shape.trunk_sides, bark, mesh);
  std::vector<Solid> solids{solid_of(name, trunk)};
  const size_t first_of_crown = mesh.index_count();

  const auto add_lump = [&](const Vector3d& center_W, const Vector3d& radii_m) {
    const Polyhedron& lump = lumps[static_cast<size_t>(uniform_index(random, static_cast<int>(lumps.size())))];
    const Polyhedron placed = moved(lump_to_world(center_W, radii_m, random), lump);
    add_polyhedron(placed, Shading::smooth, leaves, mesh);
    solids.push_back(solid_of(name, placed));
  };
  if (shape.lobes == 1) {
    add_lump(crown_center_W, crown_radii);
  } else {
    constexpr double kCore = 0.62;  // share of the crown's radii; the lobes protrude from it
    add_lump(crown_center_W, kCore * crown_radii);
    const double first_rad = uniform(random, 0.0, 2.0 * std::numbers::pi);
    const int around = shape.lobes - 1;
    for (int k = 0; k < around; ++k) {
      const double size = uniform(random, 0.22, 0.46);
      const Vector3d out = spiral_direction(k, around, first_rad);
      // Small lobes must touch the core, which has about this radius in every direction.
      const double way = std::min((1.0 - size) * uniform(random, 0.9, 1.0), 0.85 * kCore + 0.5 * size);
      add_lump(crown_center_W + crown_radii.cwiseProduct(way * out), size * crown_radii);
    }
  }
  if (shape.thins_out) {
    const double width_m = (shape.trunk_sides == 3 ? std::sqrt(3.0) : 2.0) * shape.trunk_radius_m;
    mesh.keep_from_afar(first_of_crown, width_m);
  }
  return solids;
}

}  // namespace hedgehop::scenes::mesh
