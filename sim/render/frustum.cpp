#include "sim/render/frustum.h"

namespace hedgehop::sim {

Frustum::Frustum(const vision::camera::PinholeCamera& camera, const Eigen::Isometry3d& X_WC, double near_m) {
  constexpr double kEdgePx = 1.5;  // half a pixel to the image's edge, one to spare for the rasterizer's grid
  const double left = camera.center_u_px + kEdgePx, right = camera.width_px - 1 + kEdgePx - camera.center_u_px;
  const double above = camera.center_v_px + kEdgePx, below = camera.height_px - 1 + kEdgePx - camera.center_v_px;
  const std::array<Eigen::Vector3d, 5> normals_C = {{{camera.focal_x_px, 0.0, left},
                                                     {-camera.focal_x_px, 0.0, right},
                                                     {0.0, camera.focal_y_px, above},
                                                     {0.0, -camera.focal_y_px, below},
                                                     {0.0, 0.0, 1.0}}};
  for (size_t i = 0; i < planes_.size(); ++i) {
    planes_[i].n_W = X_WC.linear() * normals_C[i];
    planes_[i].offset = -planes_[i].n_W.dot(X_WC.translation());
  }
  planes_.back().offset -= 0.5 * near_m;
}

bool Frustum::may_see(const Eigen::AlignedBox3f& box_W) const {
  for (const Plane& plane : planes_) {
    double furthest_inside = plane.offset;
    for (int i = 0; i < 3; ++i) {
      furthest_inside += plane.n_W[i] * static_cast<double>(plane.n_W[i] > 0.0 ? box_W.max()[i] : box_W.min()[i]);
    }
    if (furthest_inside < 0.0) return false;
  }
  return true;
}

}  // namespace hedgehop::sim
