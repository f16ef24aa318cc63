#include "sim/collision/solid_bodies.h"

#include <stdexcept>

namespace hedgehop::sim {
namespace {

using dynamics::HullPart;
using scenes::Solid;

constexpr double kRoundingM = 1e-9;  // tolerance of corners outside the faces of a convex body

void require_extents(const Eigen::Vector3d& half_extents_m, const std::string& name) {
  if (!half_extents_m.allFinite() || half_extents_m.minCoeff() <= 0.0) {
    throw std::invalid_argument(name + ": half extents must be finite and above 0");
  }
}

void require_polyhedron(const scenes::mesh::Polyhedron& polyhedron, bool convex, const std::string& name) {
  const auto refuse = [&](const char* why) { throw std::invalid_argument(name + ": " + why); };
  if (polyhedron.faces.empty()) refuse("a polyhedron needs faces");
  for (const Eigen::Vector3d& corner : polyhedron.corners) {
    if (!corner.allFinite()) refuse("corners must be finite");
  }
  for (const auto& face : polyhedron.faces) {
    for (const uint32_t corner : face) {
      if (corner >= polyhedron.corners.size()) refuse("a face has a corner index out of range");
    }
    const Eigen::Vector3d a = polyhedron.corners[face[0]];
    const Eigen::Vector3d n = (polyhedron.corners[face[1]] - a).cross(polyhedron.corners[face[2]] - a);
    if (n.norm() == 0.0) refuse("a face has no area");
    if (!convex) continue;
    for (const Eigen::Vector3d& corner : polyhedron.corners) {
      if (n.normalized().dot(corner - a) > kRoundingM) refuse("a hull must be convex, with outward faces");
    }
  }
  if (convex && polyhedron.faces.size() < 4) refuse("a hull needs at least 4 faces");
}

}  // namespace

ConvexBody make_body(const HullPart& part, const std::string& name) {
  require_extents(part.half_extents_m, name);
  if (!part.center_B_m.allFinite()) throw std::invalid_argument(name + ": the center must be finite");
  if (part.shape == HullPart::Shape::box) return {ConvexBody::Shape::box, part.half_extents_m};
  if (part.half_extents_m.x() != part.half_extents_m.y()) {
    throw std::invalid_argument(name + ": a cylinder's first two half extents are its radius and must be equal");
  }
  return {ConvexBody::Shape::cylinder, part.half_extents_m};
}

void require_valid(const Solid& solid) {
  const std::string name = "solid '" + solid.name + "'";
  if (!solid.X_WS.matrix().allFinite()) throw std::invalid_argument(name + ": the pose must be finite");
  const Eigen::Vector3d& half_m = solid.half_extents_m;
  const bool is_polyhedron = solid.shape == Solid::Shape::hull || solid.shape == Solid::Shape::surface;
  if (is_polyhedron) return require_polyhedron(solid.polyhedron, solid.shape == Solid::Shape::hull, name);
  require_extents(half_m, name);
  if (solid.shape == Solid::Shape::cylinder && half_m.x() != half_m.y()) {
    throw std::invalid_argument(name + ": a cylinder's first two half extents differ");
  }
  if (solid.shape == Solid::Shape::sphere && half_m.minCoeff() != half_m.maxCoeff()) {
    throw std::invalid_argument(name + ": a sphere's half extents differ");
  }
}

std::vector<PosedBody> make_bodies(const Solid& solid) {
  const Eigen::Vector3d& half_m = solid.half_extents_m;
  std::vector<PosedBody> bodies;
  switch (solid.shape) {
    case Solid::Shape::box:
      bodies.push_back({{ConvexBody::Shape::box, half_m}, solid.X_WS});
      break;
    case Solid::Shape::cylinder:
      bodies.push_back({{ConvexBody::Shape::cylinder, half_m}, solid.X_WS});
      break;
    case Solid::Shape::sphere:
      bodies.push_back({{ConvexBody::Shape::sphere, half_m}, solid.X_WS});
      break;
    case Solid::Shape::hull:
      bodies.push_back({ConvexBody(solid.polyhedron), solid.X_WS});
      break;
    case Solid::Shape::surface:
      for (const auto& [a, b, c] : solid.polyhedron.faces) {
        const std::vector<Eigen::Vector3d>& corners = solid.polyhedron.corners;
        const Eigen::Vector3d center = (corners[a] + corners[b] + corners[c]) / 3.0;
        bodies.push_back({ConvexBody(scenes::mesh::Polyhedron{
                              {corners[a] - center, corners[b] - center, corners[c] - center}, {{0, 1, 2}}}),
                          solid.X_WS * Eigen::Translation3d(center)});
      }
      break;
  }
  return bodies;
}

}  // namespace hedgehop::sim
