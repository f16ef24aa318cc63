#pragma once

#include <BulletCollision/CollisionShapes/btConvexShape.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>
#include <memory>
#include <vector>

#include "scenes/mesh/polyhedron.h"

namespace hedgehop::sim {

inline btVector3 to_bullet(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// A solid body in its own frame S: a box, an upright cylinder (axis z, half extents (r, r, half height)), a sphere
/// (half extents (r, r, r)), or a polyhedron: closed and convex, or a single triangle.
struct ConvexBody {
  enum class Shape { cylinder, box, sphere, polyhedron };

  /// A box, a cylinder or a sphere.
  ConvexBody(Shape shape, const Eigen::Vector3d& half_extents_m);
  /// @param polyhedron  in S, m: convex with at least 4 faces, or of one face.
  explicit ConvexBody(const scenes::mesh::Polyhedron& polyhedron);

  /// Point of the body nearest to p_S; p_S itself inside.
  Eigen::Vector3d nearest(const Eigen::Vector3d& p_S) const;
  /// Point of the body farthest along a direction.
  Eigen::Vector3d farthest(const Eigen::Vector3d& direction_S) const;
  /// Distance of a point inside to the nearest point outside, m; of a triangle 0.
  double depth_m(const Eigen::Vector3d& p_S) const;
  /// Distance along a ray to the body, in lengths of `ray_S`: 0 inside, +inf when it misses.
  double ray_length(const Eigen::Vector3d& p_S, const Eigen::Vector3d& ray_S) const;

  Shape shape;
  Eigen::Vector3d half_extents_m;               ///< of the box around S's origin that holds the body
  double bounding_radius_m;                     ///< of the ball around S's origin that holds the body
  scenes::mesh::Polyhedron polyhedron;          ///< of polyhedra only
  std::vector<Eigen::Vector3d> normals_S;       ///< unit; outward, of each face; of a triangle both ways
  std::unique_ptr<const btConvexShape> bullet;  ///< the same body, without Bullet's rounding margin (but for spheres)
};

/// A body at a pose.
struct PlacedBody {
  PlacedBody(const ConvexBody& body, const Eigen::Isometry3d& X_WS);

  Eigen::Vector3d nearest(const Eigen::Vector3d& p_W) const { return X_WS * body->nearest(X_SW * p_W); }
  double reach(const Eigen::Vector3d& direction_W) const;  ///< farthest extent along a direction, from W's origin
  Eigen::Vector3d half_size_W() const;  ///< of a box along W's axes around S's origin that holds the body, m

  const ConvexBody* body;
  Eigen::Isometry3d X_WS, X_SW;
  btTransform bullet_X_WS;
};

}  // namespace hedgehop::sim
