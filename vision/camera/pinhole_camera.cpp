#include "vision/camera/pinhole_camera.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace hedgehop::vision::camera {

PinholeCamera PinholeCamera::from_fov(int width_px, int height_px, double horizontal_fov_rad) {
  if (width_px < 1 || height_px < 1) {
    throw std::invalid_argument("a camera's image needs at least one pixel each way, got " + std::to_string(width_px) +
                                " x " + std::to_string(height_px));
  }
  if (!(horizontal_fov_rad > 0.0 && horizontal_fov_rad < std::numbers::pi)) {
    throw std::invalid_argument("a pinhole camera's field of view lies between 0 and pi rad, got " +
                                std::to_string(horizontal_fov_rad));
  }
  // Half the image's width (outer edge of the outermost pixel) is seen at half the field of view.
  const double focal_px = 0.5 * width_px / std::tan(0.5 * horizontal_fov_rad);
  return {width_px, height_px, focal_px, focal_px, 0.5 * (width_px - 1), 0.5 * (height_px - 1)};
}

std::optional<Eigen::Vector2d> PinholeCamera::project(const Eigen::Vector3d& p_C) const {
  if (!(p_C.z() > 0.0)) return std::nullopt;
  return Eigen::Vector2d{center_u_px + focal_x_px * p_C.x() / p_C.z(), center_v_px + focal_y_px * p_C.y() / p_C.z()};
}

Eigen::Vector3d PinholeCamera::ray_at_unit_depth(const Eigen::Vector2d& pixel) const {
  return {(pixel.x() - center_u_px) / focal_x_px, (pixel.y() - center_v_px) / focal_y_px, 1.0};
}

}  // namespace hedgehop::vision::camera
