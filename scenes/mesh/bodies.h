#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scenes/mesh/mesh_builder.h"
#include "scenes/mesh/polyhedron.h"

namespace hedgehop::scenes::mesh {

/// A texture on a body: `tile_m` is its side in m, `offset` its shift in repeats.
struct Cover {
  uint32_t texture = 0;
  double tile_m = 2.0;
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();
};

/// Normals used for lighting: those of the faces, or averages at the corners.
enum class Shading { flat, smooth };

/// Adds a polyhedron to the current chunk. The texture is projected onto each face along the direction that is closest
/// to the face's normal. The 26 directions are the axes of W and the diagonals between two or three of them.
/// @param body  in W, m.
void add_polyhedron(const Polyhedron& body, Shading shading, const Cover& cover, MeshBuilder& mesh);

/// An upright cylinder. `foot_W` is the center of its lower end, in W, m.
struct Post {
  Eigen::Vector3d foot_W = Eigen::Vector3d::Zero();
  double radius_m = 0.1;
  double height_m = 1.0;
};

/// Adds a post as a prism with `sides` sides, closed at the top and open at the bottom.
void add_post(const Post& post, int sides, const Cover& cover, MeshBuilder& mesh);

/// Adds the faces of a box, without the bottom of a box on the ground. Textures start at W's origin, so that they
/// continue from box to box. @param box_K  in a frame K, m. @param X_WK  pose of K.
void add_box(const Eigen::AlignedBox3d& box_K, const Eigen::Isometry3d& X_WK, const Cover& cover, MeshBuilder& mesh);

/// Returns a post as a solid.
Solid solid_of(const std::string& name, const Post& post);

/// Returns a convex polyhedron as a solid. S has the axes of W and its origin at the center of the bounding box.
/// @param body  in W, m.
Solid solid_of(const std::string& name, const Polyhedron& body);

/// Returns a solid sphere. @param center_W  m.
Solid ball_of(const std::string& name, const Eigen::Vector3d& center_W, double radius_m);

/// The surface of a cell of the ground.
struct GroundCell {
  Cover cover;
  bool is_road = false;
  /// Adds the cell in place of one panel with the cover, if it is not empty.
  std::function<void(const TexturedPanel&, const ImageArea&)> add = {};
};

/// Adds the ground at z = 0 in a chunk of its own: a grid of panels that extends at least 12 km from the origin. Its
/// instances are the ground and, if a cell has one, the road. Textures start at W's origin.
/// @param norths_m, easts_m  lines of the grid, in order; at least two of each, on both sides of 0.
/// @param cell_at  returns a cell from its center in the plan (north, east), m.
void add_ground(std::vector<double> norths_m, std::vector<double> easts_m,
                const std::function<GroundCell(const Eigen::Vector2d& middle_NE)>& cell_at, MeshBuilder& mesh);

/// Adds ground with one texture. The grid is fine within `half_m` of the origin.
void add_ground(double half_m, const Cover& cover, MeshBuilder& mesh);

}  // namespace hedgehop::scenes::mesh
