#pragma once

#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <LinearMath/btTransform.h>

#include <Eigen/Core>
#include <optional>

namespace hedgehop::sim {

/// Returns how much of a segment lies before a shape of any kind that Bullet knows, 0..1; none when they miss each
/// other. Good to about 1e-6 of the segment's length; one that passes an edge within about 0.01 m may count as a hit. A
/// convex shape that holds the segment's beginning is not seen.
/// @param X_WS  pose of the shape. @param from_W, to_W  ends of the segment, m, not equal.
std::optional<double> ray_fraction(const btCollisionShape& shape, const btTransform& X_WS,
                                   const Eigen::Vector3d& from_W, const Eigen::Vector3d& to_W);

}  // namespace hedgehop::sim
