#pragma once

#include <BulletCollision/CollisionShapes/btConvexShape.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>

namespace hedgehop::sim {

/// A solid box, or an upright solid cylinder (axis z, half extents (r, r, half height)), in its own frame S.
struct ConvexBody {
  enum class Shape { cylinder, box };

  ConvexBody(Shape shape, const Eigen::Vector3d& half_extents_m);

  /// Point of the body nearest to p_S; p_S itself inside.
  Eigen::Vector3d nearest(const Eigen::Vector3d& p_S) const;
  /// Point of the body farthest along a direction.
  Eigen::Vector3d farthest(const Eigen::Vector3d& direction_S) const;

  Shape shape;
  Eigen::Vector3d half_extents_m;
  double bounding_radius_m;                     ///< of the ball round S's origin that holds the body
  std::unique_ptr<const btConvexShape> bullet;  ///< the same body, without Bullet's rounding margin
};

/// A body where a pose puts it.
struct PlacedBody {
  PlacedBody(const ConvexBody& body, const Eigen::Isometry3d& X_WS);

  Eigen::Vector3d nearest(const Eigen::Vector3d& p_W) const { return X_WS * body->nearest(X_SW * p_W); }
  double reach(const Eigen::Vector3d& direction_W) const;  ///< farthest extent along a direction, from W's origin

  const ConvexBody* body;
  Eigen::Isometry3d X_WS, X_SW;
  btTransform bullet_X_WS;
};

struct Separation {
  double distance_m = 0.0;                                ///< < 0: depth of the overlap
  Eigen::Vector3d on_first_W = Eigen::Vector3d::Zero();   ///< the first body's point nearest to the second, m
  Eigen::Vector3d on_second_W = Eigen::Vector3d::Zero();  ///< and the second's nearest to the first
};

/// Returns the distance of two bodies, to 1e-7 m, by a certificate. Nearer than that they touch: then the result is 0
/// or, as Bullet tells it, the depth of their overlap, good to about 1e-4 m.
Separation separate(const PlacedBody& first, const PlacedBody& second);

}  // namespace hedgehop::sim
