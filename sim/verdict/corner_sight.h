#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "sim/collision/proximity.h"
#include "vision/camera/camera.h"

namespace hedgehop::sim {

/// Pixels of those corners that lie in a camera's image, whatever stands before them, each with white noise: the
/// front end of [Shah2009] ch. 4, which has no images.
class ProjectedCorners {
 public:
  /// @param corners_W  m. @param seed  of the noise's stream.
  ProjectedCorners(std::vector<Eigen::Vector3d> corners_W, uint64_t seed);

  /// @param X_WC  pose of the camera, true. Each call draws new noise.
  std::vector<Eigen::Vector2d> project(const vision::camera::Camera& camera, const Eigen::Isometry3d& X_WC);

 private:
  std::vector<Eigen::Vector3d> corners_W_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

/// Which corners a camera sees. @param world  what may stand before them; null for a sight through walls.
/// @param X_WC  pose of the camera, true. @param t_s  when, >= 0: where the movers are.
std::vector<bool> corners_in_sight(std::span<const Eigen::Vector3d> corners_W, const vision::camera::Camera& camera,
                                   const Eigen::Isometry3d& X_WC, const CollisionWorld* world, double t_s);

}  // namespace hedgehop::sim
