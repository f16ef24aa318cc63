#pragma once

#include <span>
#include <string>
#include <vector>

#include "scenes/mesh/bodies.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes::mesh {

/// A tree: a trunk from the ground to the center of its crown.
struct TreeShape {
  Eigen::Vector3d foot_W = Eigen::Vector3d::Zero();
  double height_m = 12.0;
  double clear_height_m = 3.0;  ///< of the trunk below the crown, < height
  double crown_radius_m = 3.0;
  double trunk_radius_m = 0.2;
  int lobes = 1;        ///< lumps of the crown: 1, or a core with lobes - 1 lumps around it
  int trunk_sides = 6;  ///< at least 3
  /// Whether the far detail omits the trunk. All trees of a chunk must agree, and the chunk must contain only trees.
  bool thins_out = false;
};

/// Adds a tree to the current chunk. All points lie within the crown's radius of the trunk's axis and below the height.
/// @param lumps  convex lumps for the crown, at least one, within radius 1; for a crown without lobes, within 1 of the
/// vertical axis and between -1 and 1 along it.
/// @return the trunk (a cylinder) and the lumps of the crown (hulls equal to the drawn ones), each named `name`.
std::vector<Solid> add_tree(const std::string& name, const TreeShape& shape, std::span<const Polyhedron> lumps,
                            const Cover& leaves, const Cover& bark, Random& random, MeshBuilder& mesh);

}  // namespace hedgehop::scenes::mesh
