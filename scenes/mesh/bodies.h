#pragma once

#include <string>

#include "scenes/mesh/mesh_builder.h"
#include "scenes/mesh/polyhedron.h"

namespace hedgehop::scenes::mesh {

/// An image on a rounded body: `tile_m` meters a side, moved by `offset` repeats.
struct Cover {
  uint32_t texture = 0;
  double tile_m = 2.0;
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();
};

/// Whether a body's faces are lit as they are, or with smoothed normals.
enum class Shading { flat, smooth };

/// Adds a polyhedron to the chunk begun last. Each face takes the image from the side that it looks to most, of 26:
/// those along the axes of W and those between two or three of them.
/// @param body  in W, m.
void add_polyhedron(const Polyhedron& body, Shading shading, const Cover& cover, MeshBuilder& mesh);

/// An upright cylinder: foot_W is the center of its lower end, in W, m.
struct Post {
  Eigen::Vector3d foot_W = Eigen::Vector3d::Zero();
  double radius_m = 0.1;
  double height_m = 1.0;
};

/// Adds a post with `sides` corners on its circle, closed on top, open below.
void add_post(const Post& post, int sides, const Cover& cover, MeshBuilder& mesh);

/// Adds the faces of a box, but not the bottom when it stands on the ground. Images are laid out from W's origin, so
/// that they run on from box to box.
/// @param box_K  in a frame K, m. @param X_WK  pose of K.
void add_box(const Eigen::AlignedBox3d& box_K, const Eigen::Isometry3d& X_WK, const Cover& cover, MeshBuilder& mesh);

Solid solid_of(const std::string& name, const Post& post);

/// Returns a convex polyhedron as a solid; S has the axes of W and its origin in the middle of the bounds.
/// @param body  in W, m.
Solid solid_of(const std::string& name, const Polyhedron& body);

/// Returns a solid ball. @param center_W  m.
Solid ball_of(const std::string& name, const Eigen::Vector3d& center_W, double radius_m);

}  // namespace hedgehop::scenes::mesh
