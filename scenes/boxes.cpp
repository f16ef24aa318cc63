#include "scenes/boxes.h"

#include "scenes/mesh/bodies.h"
#include "scenes/textures/stone_textures.h"
#include "sim/fields/bounds.h"

namespace hedgehop::scenes {
namespace {

using Eigen::Vector3d;

/// From the box's own axes (along, across, down; origin in the middle of its foot) to W.
Eigen::Isometry3d X_WK(const BoxConfig& c) {
  return Eigen::Translation3d(c.north_m, c.east_m, 0.0) * Eigen::AngleAxisd(c.heading_rad, Vector3d::UnitZ());
}

}  // namespace

std::vector<Eigen::Vector2d> BoxConfig::corners_NE_m() const {
  std::vector<Eigen::Vector2d> corners;
  for (const auto& [along, across] : {std::pair{0.5, 0.5}, {0.5, -0.5}, {-0.5, -0.5}, {-0.5, 0.5}}) {
    corners.push_back((X_WK(*this) * Vector3d(along * length_m, across * width_m, 0.0)).head<2>());
  }
  return corners;
}

void add_boxes(const std::vector<BoxConfig>& boxes, uint64_t seed, Scene& scene) {
  if (boxes.empty()) return;
  constexpr int kSizePx = 512;  // where the scene has no images
  const int size_px = scene.textures.empty() ? kSizePx : scene.textures.front().cols;
  const mesh::Cover brick{static_cast<uint32_t>(scene.textures.size()), textures::kWallTileM};
  scene.textures.push_back(textures::paint_brick_wall(size_px, seed));
  mesh::MeshBuilder builder("opaque");
  for (size_t k = 0; k < boxes.size(); ++k) {
    const BoxConfig& c = boxes[k];
    fields::require_bounds(c, "boxes." + std::to_string(k));
    const Eigen::AlignedBox3d box_K(Vector3d(-0.5 * c.length_m, -0.5 * c.width_m, -c.height_m),
                                    Vector3d(0.5 * c.length_m, 0.5 * c.width_m, 0.0));
    builder.begin_chunk(c.heading_rad == 0.0);  // a turned one does not fill the bounds of its chunk
    mesh::add_box(box_K, X_WK(c), brick, builder);
    scene.solids.push_back(mesh::solid_of(c.name, box_K, X_WK(c)));
  }
  scene.meshes.push_back(builder.finish());
}

}  // namespace hedgehop::scenes
