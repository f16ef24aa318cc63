#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "sim/collision/proximity.h"
#include "vision/camera/camera.h"

namespace hedgehop::sim {

/// Returns which corners a camera sees. @param world  solids that may hide them; null for a camera that sees through
/// walls. @param X_WC  pose of the camera, true. @param t_s  >= 0: where the movers are.
std::vector<bool> corners_in_sight(std::span<const Eigen::Vector3d> corners_W, const vision::camera::Camera& camera,
                                   const Eigen::Isometry3d& X_WC, const CollisionWorld* world, double t_s);

}  // namespace hedgehop::sim
