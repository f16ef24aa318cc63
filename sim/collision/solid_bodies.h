#pragma once

#include <string>
#include <vector>

#include "dynamics/hull.h"
#include "scenes/scene.h"
#include "sim/collision/convex_body.h"

/// The convex bodies of which solids and hulls consist.
namespace hedgehop::sim {

/// Returns the body of a hull's part, in the part's own frame: axes of B, origin at its center.
/// @param what  name of the part, for the message. Throws std::invalid_argument when a half extent is not finite and
/// positive, a cylinder's first two half extents differ, or the center is not finite.
ConvexBody make_body(const dynamics::HullPart& part, const std::string& what);

/// Returns the bodies of a solid, in S: one, or each triangle of a surface.
/// Throws std::invalid_argument, naming the solid, when its pose or an extent is not finite or out of range, when radii
/// that must be equal differ, or when a polyhedron has no faces, a corner index out of range, a face without area or,
/// as a hull, is not convex.
std::vector<ConvexBody> make_bodies(const scenes::Solid& solid);

}  // namespace hedgehop::sim
