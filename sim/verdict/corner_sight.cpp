#include "sim/verdict/corner_sight.h"

namespace hedgehop::sim {
namespace {

bool in_image(const vision::camera::Camera& camera, const Eigen::Isometry3d& X_WC, const Eigen::Vector3d& p_W) {
  const auto pixel = camera.project(X_WC.inverse() * p_W);
  return pixel && pixel->x() >= 0.0 && pixel->y() >= 0.0 && pixel->x() <= camera.width_px - 1 &&
         pixel->y() <= camera.height_px - 1;
}

bool nothing_hides(const CollisionWorld& world, const Eigen::Vector3d& p_WC, const Eigen::Vector3d& p_W, double t_s) {
  constexpr double kOfItselfM = 0.1;  // the ray may meet the point's own surface a little before the point
  const Eigen::Vector3d ray_W = p_W - p_WC;
  const double distance_m = ray_W.norm();
  if (distance_m <= kOfItselfM) return true;
  return world.distance_along(p_WC, ray_W / distance_m, distance_m, t_s) >= distance_m - kOfItselfM;
}

}  // namespace

std::vector<bool> corners_in_sight(std::span<const Eigen::Vector3d> corners_W, const vision::camera::Camera& camera,
                                   const Eigen::Isometry3d& X_WC, const CollisionWorld* world, double t_s) {
  std::vector<bool> seen;
  for (const Eigen::Vector3d& p_W : corners_W) {
    seen.push_back(in_image(camera, X_WC, p_W) && (!world || nothing_hides(*world, X_WC.translation(), p_W, t_s)));
  }
  return seen;
}

}  // namespace hedgehop::sim
