#include "vision/motion/match_error.h"

#include <algorithm>
#include <cmath>

namespace hedgehop::vision::motion {

constexpr double kNoLength = 1e-12;  // px; shorter displacements have no direction

double noise_px2(const Eigen::Vector3d& gradients, const Eigen::Vector2d& along_px, const MatchNoise& noise) {
  const Eigen::Vector2d e = along_px / std::max(along_px.norm(), kNoLength);
  const double texture =
      e.x() * e.x() * gradients[0] + 2.0 * e.x() * e.y() * gradients[1] + e.y() * e.y() * gradients[2];
  return 2.0 * noise.grey * noise.grey / std::max(texture, kNoLength);
}

Eigen::Vector2d displacement(const Eigen::Vector3d& ray_C, const Eigen::Vector3d& p_CCk, double per_m,
                             double focal_px) {
  const double depth_ratio = 1.0 - per_m * p_CCk.z();  // z in Ck divided by z in C
  return focal_px / (depth_ratio * depth_ratio) * (ray_C.head<2>() * p_CCk.z() - p_CCk.head<2>());
}

double sigma_of_inverse_depth(const Eigen::Vector3d& ray_C, const CameraMotion& motion, double per_m, double focal_px,
                              const Eigen::Vector3d& gradients, const MatchNoise& noise) {
  const Eigen::Vector2d along_px = displacement(ray_C, motion.p_CCk, per_m, focal_px);
  const double length = along_px.norm();
  const Eigen::Vector2d e = along_px / std::max(length, kNoLength);
  const double inclined_px = noise.share * per_m * length;
  const double match_px2 =
      noise_px2(gradients, along_px, noise) + noise.floor_px * noise.floor_px + inclined_px * inclined_px;
  // Derivatives of the place in the key image along e with respect to p_CCk and to a rotation.
  const double depth_ratio = 1.0 - per_m * motion.p_CCk.z();
  const double radial = e.dot(ray_C.head<2>() - per_m * motion.p_CCk.head<2>()) / depth_ratio;
  const double sensitivity = std::sqrt(1.0 + radial * radial);
  const double p_px = focal_px * per_m / depth_ratio * sensitivity * motion.sigma_p_m;
  const double turn_px = focal_px * sensitivity * motion.sigma_rad;
  return std::sqrt(match_px2 + p_px * p_px + turn_px * turn_px) / length;
}

}  // namespace hedgehop::vision::motion
