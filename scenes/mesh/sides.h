#pragma once

#include "scenes/mesh/polyhedron.h"

namespace hedgehop::scenes::mesh {

/// Where the triangles of a mesh face: those of a closed body outward, as they should, or inward, as careless programs
/// write them; those of an open surface one way, though it may be seen from both.
enum class Facing { outward, inward, open };

/// Closed is a body each of whose edges is run along once in each direction; corners of equal place are one corner.
Facing facing_of(const Polyhedron& body);

}  // namespace hedgehop::scenes::mesh
