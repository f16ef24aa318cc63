#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <unsupported/Eigen/BVH>
#include <vector>

#include "scenes/scene.h"
#include "sim/collision/convex_body.h"

namespace hedgehop::sim {

/// The triangles of all surfaces that do not move, in a tree of boxes that is built once. The boxes are in single
/// precision and contain their triangles, so they only select candidates; bodies are in double precision.
class SurfaceTree {
 public:
  /// A triangle as a body, in the frame of its center.
  struct TriangleBody {
    TriangleBody(const scenes::mesh::Polyhedron& triangle, const Eigen::Isometry3d& X_WS)
        : body(triangle), placed(body, X_WS) {}
    TriangleBody(const TriangleBody&) = delete;
    TriangleBody& operator=(const TriangleBody&) = delete;
    ConvexBody body;
    PlacedBody placed;
  };
  using Visit = std::function<void(size_t id, const PlacedBody& body)>;

  /// Adds a surface. @param solid  valid, with a pose; copied. @param first_id  of its triangles, in order; larger than
  /// those of earlier surfaces.
  void add(const scenes::Solid& solid, size_t first_id);
  /// Builds the tree of all surfaces that were added.
  void build();

  /// Returns whether a triangle has this id.
  bool has(size_t id) const;
  /// Calls `visit` with one triangle.
  void visit_one(size_t id, const Visit& visit) const;
  /// Calls `visit` with every triangle within a distance of a body, nearer boxes first. @param distance_m  lower bound
  /// of the distance of the body from a box. @param reach_m  the distance, >= 0; called after each visit, so that it
  /// may shrink.
  void visit_near(const std::function<double(const Eigen::AlignedBox3d& box_W)>& distance_m,
                  const std::function<double()>& reach_m, const Visit& visit) const;
  /// Calls `visit` with every triangle whose box a segment meets.
  void visit_along(const Eigen::Vector3d& from_W, const Eigen::Vector3d& to_W, const Visit& visit) const;

 private:
  struct Surface {
    scenes::mesh::Polyhedron polyhedron;
    Eigen::Isometry3d X_WS;
    size_t first_id = 0;
  };
  const Surface& surface_of(size_t id) const;
  Eigen::AlignedBox3f box_of_triangle(size_t id) const;

  std::vector<Surface> surfaces_;
  Eigen::KdBVH<float, 3, uint32_t> tree_;
};

}  // namespace hedgehop::sim
