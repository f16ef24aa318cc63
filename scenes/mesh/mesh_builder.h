#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "scenes/scene.h"

namespace hedgehop::scenes::mesh {

/// A rectangle in space that carries an image upright: seen from outside, `right_m` runs to the viewer's right and
/// `down_m` down the image. Its outward normal is -(right x down).
struct TexturedPanel {
  Eigen::Vector3d top_left_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d right_m = Eigen::Vector3d::UnitY();
  Eigen::Vector3d down_m = Eigen::Vector3d::UnitZ();
};

/// Part of an image, in repeats of it: u to the right, v down, (0, 0) its top left corner.
struct ImageArea {
  double u0 = 0.0, v0 = 0.0, u1 = 1.0, v1 = 1.0;
};

/// The faces of a box by their outward normals in W: the horizontal ones in the order north, east, south, west.
std::array<TexturedPanel, 4> side_panels(const Eigen::AlignedBox3d& box_W);
TexturedPanel top_panel(const Eigen::AlignedBox3d& box_W);     ///< image up = north
TexturedPanel bottom_panel(const Eigen::AlignedBox3d& box_W);  ///< image up = north

/// Returns the box as a solid.
Solid solid_of(const std::string& name, const Eigen::AlignedBox3d& box_W);
/// Returns a box of any pose as a solid. @param box_K  in a frame K, m. @param X_WK  pose of K.
Solid solid_of(const std::string& name, const Eigen::AlignedBox3d& box_K, const Eigen::Isometry3d& X_WK);

/// Grows a mesh chunk by chunk. Every panel belongs to the chunk begun last; close with `finish()`.
class MeshBuilder {
 public:
  explicit MeshBuilder(std::string material) { mesh_.material = std::move(material); }

  void begin_chunk(bool fills_box_to_ground);
  void add(const TexturedPanel& panel, const ImageArea& area, uint32_t texture);

  /// Adds the panel with an image of `tile_m` meters a side, its corner moved by `offset` repeats.
  void add_tiled(const TexturedPanel& panel, double tile_m, const Eigen::Vector2d& offset, uint32_t texture);

  /// Adds triangles; `faces` index into `vertices`.
  void add(std::span<const Vertex> vertices, std::span<const std::array<uint32_t, 3>> faces);

  /// Number of indices so far.
  size_t index_count() const { return mesh_.indices.size(); }

  /// Makes the triangles since then a part of the chunk's far detail. @param first_index  an index_count() of the chunk
  /// begun last. @param lost_m  width of what else was added, > 0; of a chunk's parts, the widest counts.
  void keep_from_afar(size_t first_index, double lost_m);

  Mesh finish();

 private:
  Mesh mesh_;
};

}  // namespace hedgehop::scenes::mesh
