#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <random>
#include <vector>

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

}  // namespace hedgehop::sim
