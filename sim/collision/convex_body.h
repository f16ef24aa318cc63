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

/// A convex body in its own frame S: a box, an upright cylinder (axis z, half extents (r, r, half height)), a sphere
/// (half extents (r, r, r)), or a polyhedron, which is closed and convex or a single triangle.
struct ConvexBody {
  enum class Shape { cylinder, box, sphere, polyhedron };

  /// A box, a cylinder or a sphere.
  ConvexBody(Shape shape, const Eigen::Vector3d& half_extents_m);
  /// @param polyhedron  in S, m: convex with at least 4 faces, or of one face.
  explicit ConvexBody(const scenes::mesh::Polyhedron& polyhedron);

  /// Returns the point of the body nearest to p_S; p_S itself if it is inside.
  Eigen::Vector3d nearest(const Eigen::Vector3d& p_S) const;
  /// Returns the support point: that of the body with the maximum extent along a direction.
  Eigen::Vector3d support(const Eigen::Vector3d& direction_S) const;
  /// Returns the distance of an inner point from the surface, m; 0 for a triangle.
  double depth_m(const Eigen::Vector3d& p_S) const;
  /// Returns the distance along a ray to the body, in lengths of `ray_S`: 0 inside, +inf if it misses.
  double ray_length(const Eigen::Vector3d& p_S, const Eigen::Vector3d& ray_S) const;

  Shape shape;
  Eigen::Vector3d half_extents_m;               ///< of the box around S's origin that contains the body
  double bounding_radius_m;                     ///< of the ball around S's origin that contains the body
  scenes::mesh::Polyhedron polyhedron;          ///< of polyhedra only
  std::vector<Eigen::Vector3d> normals_S;       ///< unit, outward, of each face; both directions for a triangle
  std::unique_ptr<const btConvexShape> bullet;  ///< the same body, without Bullet's margin (except spheres)
};

/// A body at a pose.
struct PlacedBody {
  PlacedBody(const ConvexBody& body, const Eigen::Isometry3d& X_WS);

  Eigen::Vector3d nearest(const Eigen::Vector3d& p_W) const { return X_WS * body->nearest(X_SW * p_W); }
  double extent(const Eigen::Vector3d& direction_W) const;  ///< maximum along a direction, from W's origin
  Eigen::Vector3d half_size_W() const;  ///< of the box along W's axes around S's origin that contains the body, m

  const ConvexBody* body;
  Eigen::Isometry3d X_WS, X_SW;
  btTransform bullet_X_WS;
};

struct Separation {
  double distance_m = 0.0;                                ///< < 0: depth of the overlap
  Eigen::Vector3d on_first_W = Eigen::Vector3d::Zero();   ///< the first body's point nearest to the second, m
  Eigen::Vector3d on_second_W = Eigen::Vector3d::Zero();  ///< and the second's nearest to the first
};

/// Returns the distance of two bodies, certified to 1e-7 m. Closer bodies are in contact: the result is 0 or the depth
/// of their overlap by Bullet, to about 1e-4 m. With a sphere, distance and depth are closed forms.
Separation separate(const PlacedBody& first, const PlacedBody& second);

}  // namespace hedgehop::sim
