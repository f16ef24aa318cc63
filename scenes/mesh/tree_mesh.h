#pragma once

#include <span>
#include <string>
#include <vector>

#include "scenes/mesh/bodies.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes::mesh {

/// A tree: a trunk from the ground into the middle of its crown.
struct TreeShape {
  Eigen::Vector3d foot_W = Eigen::Vector3d::Zero();
  double height_m = 12.0;
  double clear_height_m = 3.0;  ///< of the trunk below the crown, < height
  double crown_radius_m = 3.0;
  double trunk_radius_m = 0.2;
  int lobes = 1;        ///< lumps that make up the crown: 1, or a core with lobes - 1 around it
  int trunk_sides = 6;  ///< at least 3
  /// Whether the trunk may be left out from far away. All trees of a chunk agree, and nothing else is in it.
  bool thins_out = false;
};

/// Adds a tree to the chunk begun last. No point is farther from the trunk's axis than
/// the crown's radius, nor higher than the height.
/// @param lumps  convex lumps within radius 1 that the crown is made of, at least one; of a crown without lobes, within
/// 1 of its axis and within 1 above and below.
/// @return the trunk (a cylinder) and the crown's lumps (hulls that are drawn as they are), each called `name`.
std::vector<Solid> add_tree(const std::string& name, const TreeShape& shape, std::span<const Polyhedron> lumps,
                            const Cover& leaves, const Cover& bark, Random& random, MeshBuilder& mesh);

}  // namespace hedgehop::scenes::mesh
