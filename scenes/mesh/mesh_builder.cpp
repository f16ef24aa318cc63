#include "scenes/mesh/mesh_builder.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "scenes/mesh/make_room.h"

namespace hedgehop::scenes::mesh {

std::array<TexturedPanel, 4> side_panels(const Eigen::AlignedBox3d& box_W) {
  const Eigen::Vector3d low = box_W.min();
  const Eigen::Vector3d size = box_W.sizes();
  const Eigen::Vector3d down(0.0, 0.0, size.z());
  const double top = low.z();
  const Eigen::Vector3d high(box_W.max().x(), box_W.max().y(), top);
  return {TexturedPanel{high, {0.0, -size.y(), 0.0}, down},                       // north: right is west
          TexturedPanel{{low.x(), high.y(), top}, {size.x(), 0.0, 0.0}, down},    // east: right is north
          TexturedPanel{low, {0.0, size.y(), 0.0}, down},                         // south: right is east
          TexturedPanel{{high.x(), low.y(), top}, {-size.x(), 0.0, 0.0}, down}};  // west: right is south
}

TexturedPanel top_panel(const Eigen::AlignedBox3d& box_W) {
  const Eigen::Vector3d size = box_W.sizes();
  return {{box_W.max().x(), box_W.min().y(), box_W.min().z()}, {0.0, size.y(), 0.0}, {-size.x(), 0.0, 0.0}};
}

TexturedPanel bottom_panel(const Eigen::AlignedBox3d& box_W) {
  const Eigen::Vector3d size = box_W.sizes();
  return {box_W.max(), {0.0, -size.y(), 0.0}, {-size.x(), 0.0, 0.0}};
}

Solid solid_of(const std::string& name, const Eigen::AlignedBox3d& box_W) {
  Solid solid;
  solid.name = name;
  solid.X_WS.translation() = box_W.center();
  solid.half_extents_m = 0.5 * box_W.sizes();
  return solid;
}

Solid solid_of(const std::string& name, const Eigen::AlignedBox3d& box_K, const Eigen::Isometry3d& X_WK) {
  Solid solid = solid_of(name, box_K);
  solid.X_WS = X_WK * solid.X_WS;
  return solid;
}

uint32_t MeshBuilder::begin_instance(const std::string& name, SemanticClass kind) {
  instance_ = static_cast<uint32_t>(mesh_.instances.size());
  mesh_.instances.push_back({name, kind});
  return instance_;
}

void MeshBuilder::begin_chunk(bool fills_box_to_ground) {
  Chunk chunk;
  chunk.first_index = static_cast<uint32_t>(mesh_.indices.size());
  chunk.fills_box_to_ground = fills_box_to_ground;
  mesh_.chunks.push_back(chunk);
}

void MeshBuilder::add(const TexturedPanel& panel, const ImageArea& area, uint32_t texture) {
  const Eigen::Vector3f normal = -panel.right_m.cross(panel.down_m).normalized().cast<float>();
  const auto first = static_cast<uint32_t>(mesh_.vertices.size());
  const auto corner = [&](bool right, bool down) {
    Eigen::Vector3d p_W = panel.top_left_W;
    if (right) p_W += panel.right_m;
    if (down) p_W += panel.down_m;
    const Eigen::Vector2d uv(right ? area.u1 : area.u0, down ? area.v1 : area.v0);
    mesh_.vertices.push_back({p_W.cast<float>(), normal, uv.cast<float>(), texture, instance_});
    mesh_.chunks.back().box_W.extend(mesh_.vertices.back().p_W);
  };

  // Top left, bottom left, bottom right, top right: counter-clockwise seen from outside.
  corner(false, false);
  corner(false, true);
  corner(true, true);
  corner(true, false);
  for (uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) mesh_.indices.push_back(first + k);
  mesh_.chunks.back().index_count += 6;
}

void MeshBuilder::add_tiled(const TexturedPanel& panel, double tile_m, const Eigen::Vector2d& offset,
                            uint32_t texture) {
  const double across = panel.right_m.norm() / tile_m;
  const double along = panel.down_m.norm() / tile_m;
  add(panel, {offset.x(), offset.y(), offset.x() + across, offset.y() + along}, texture);
}

void MeshBuilder::add(std::span<const Vertex> vertices, std::span<const std::array<uint32_t, 3>> faces) {
  const auto first = static_cast<uint32_t>(mesh_.vertices.size());
  make_room(mesh_.vertices, vertices.size());
  make_room(mesh_.indices, 3 * faces.size());
  for (const Vertex& vertex : vertices) {
    mesh_.vertices.push_back(vertex);
    mesh_.vertices.back().instance = instance_;
    mesh_.chunks.back().box_W.extend(vertex.p_W);
  }
  for (const std::array<uint32_t, 3>& face : faces) {
    for (const uint32_t corner : face) mesh_.indices.push_back(first + corner);
  }
  mesh_.chunks.back().index_count += static_cast<uint32_t>(3 * faces.size());
}

void MeshBuilder::keep_from_afar(size_t first_index, double lost_m) {
  FarDetail& far = mesh_.chunks.back().far;
  if (far.index_count == 0) far.first_index = static_cast<uint32_t>(mesh_.far_indices.size());
  const auto since = mesh_.indices.begin() + static_cast<std::ptrdiff_t>(first_index);
  mesh_.far_indices.insert(mesh_.far_indices.end(), since, mesh_.indices.end());
  far.index_count += static_cast<uint32_t>(mesh_.indices.end() - since);
  far.lost_m = std::max(far.lost_m, static_cast<float>(lost_m));
}

void MeshBuilder::move_to_far(size_t first_index, double lost_m) {
  keep_from_afar(first_index, lost_m);
  mesh_.chunks.back().index_count -= static_cast<uint32_t>(mesh_.indices.size() - first_index);
  mesh_.indices.resize(first_index);
}

Mesh MeshBuilder::finish() {
  if (mesh_.instances.empty()) mesh_.instances.resize(1);
  return std::move(mesh_);
}

}  // namespace hedgehop::scenes::mesh
