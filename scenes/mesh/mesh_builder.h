#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "scenes/scene.h"

namespace hedgehop::scenes::mesh {

/// A textured rectangle. Seen from outside, `right_m` points to the viewer's right and `down_m` down the image. The
/// outward normal is -(right x down).
struct TexturedPanel {
  Eigen::Vector3d top_left_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d right_m = Eigen::Vector3d::UnitY();
  Eigen::Vector3d down_m = Eigen::Vector3d::UnitZ();
};

/// Part of a texture, in repeats: u to the right, v down, (0, 0) at the top left corner.
struct ImageArea {
  double u0 = 0.0, v0 = 0.0, u1 = 1.0, v1 = 1.0;
};

/// The side faces of a box, with outward normals north, east, south and west in W, in this order.
std::array<TexturedPanel, 4> side_panels(const Eigen::AlignedBox3d& box_W);
TexturedPanel top_panel(const Eigen::AlignedBox3d& box_W);     ///< up in the image is north
TexturedPanel bottom_panel(const Eigen::AlignedBox3d& box_W);  ///< up in the image is north

/// Returns the box as a solid.
Solid solid_of(const std::string& name, const Eigen::AlignedBox3d& box_W);
/// Returns a box of arbitrary pose as a solid. @param box_K  in a frame K, m. @param X_WK  pose of K.
Solid solid_of(const std::string& name, const Eigen::AlignedBox3d& box_K, const Eigen::Isometry3d& X_WK);

/// Builds a mesh chunk by chunk. Faces are added to the current chunk, the last one begun, and to the current instance.
class MeshBuilder {
 public:
  explicit MeshBuilder(std::string material) {
    mesh_.material = std::move(material);
    mesh_.instances.clear();
  }

  /// Begins an instance. Instances and chunks are independent of each other. @return its index in the mesh.
  uint32_t begin_instance(const std::string& name, SemanticClass kind);
  /// Makes an earlier instance the current one.
  void resume_instance(uint32_t instance) { instance_ = instance; }

  void begin_chunk(bool fills_box_to_ground);
  void add(const TexturedPanel& panel, const ImageArea& area, uint32_t texture);

  /// Adds a panel with a texture whose side is `tile_m`, m, shifted by `offset` repeats.
  void add_tiled(const TexturedPanel& panel, double tile_m, const Eigen::Vector2d& offset, uint32_t texture);

  /// Adds triangles; `faces` index into `vertices`.
  void add(std::span<const Vertex> vertices, std::span<const std::array<uint32_t, 3>> faces);

  /// Returns the number of indices so far.
  size_t index_count() const { return mesh_.indices.size(); }

  /// Adds the triangles since `first_index` to the far detail of the current chunk.
  /// @param first_index  an earlier index_count() of this chunk. @param lost_m  width of the part that the far detail
  /// omits, > 0, m; a chunk keeps the maximum.
  void keep_from_afar(size_t first_index, double lost_m);

  /// Moves the triangles since `first_index` from the current chunk to its far detail. @see keep_from_afar()
  /// @param lost_m  twice the distance of the surfaces of the far detail from those of the chunk, > 0, m.
  void move_to_far(size_t first_index, double lost_m);

  /// Sets the opaque core of the current chunk. @see Chunk::core_W
  void set_core(const Eigen::AlignedBox3f& core_W) { mesh_.chunks.back().core_W = core_W; }

  /// Returns the mesh.
  Mesh finish();

 private:
  Mesh mesh_;
  uint32_t instance_ = 0;
};

}  // namespace hedgehop::scenes::mesh
