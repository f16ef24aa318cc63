#pragma once

#include <string>
#include <vector>

#include "dynamics/hull.h"
#include "scenes/scene.h"
#include "sim/collision/convex_body.h"

/// Convex bodies of solids and hulls.
namespace hedgehop::sim {

/// Returns the body of a hull part, in the frame of the part: axes of B, origin at its center.
/// @param name  of the part, for the message. Throws std::invalid_argument if a half extent is not finite and positive,
/// the first two half extents of a cylinder differ, or the center is not finite.
ConvexBody make_body(const dynamics::HullPart& part, const std::string& name);

/// A convex body and its pose. The origin of its frame is near its center.
struct PosedBody {
  ConvexBody body;
  Eigen::Isometry3d X_WS;
};

/// Throws std::invalid_argument that names the solid if its pose or an extent is not finite or out of range, radii that
/// must be equal differ, or a polyhedron has no faces, a corner index out of range, a face without area or, as a hull,
/// is not convex.
void require_valid(const scenes::Solid& solid);

/// Returns the bodies of a valid solid: one, or each triangle of a surface.
std::vector<PosedBody> make_bodies(const scenes::Solid& solid);

}  // namespace hedgehop::sim
