#pragma once

#include <vector>

#include "scenes/mesh/polyhedron.h"

namespace hedgehop::scenes::mesh {

/// Orientation of a triangle. Those of a closed body should face outward, but some files store them inward.
enum class Facing { outward, inward, open };

/// Returns the orientation of each face, judged per connected body. Triangles that share an edge are connected; corners
/// at the same position count as one. A body is closed if each edge occurs once in each direction. The wall of a cavity
/// inside another closed body faces outward, from its material.
std::vector<Facing> facing_of_faces(const Polyhedron& mesh);

}  // namespace hedgehop::scenes::mesh
