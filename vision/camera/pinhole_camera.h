#pragma once

#include <Eigen/Core>
#include <optional>

namespace hedgehop::vision::camera {

/// Undistorted pinhole camera. Frame C: x right, y down, z forward. Pixel (0, 0) is the center of the top-left pixel,
/// u right, v down, so an image covers u in [-0.5, width - 0.5].
struct PinholeCamera {
  int width_px = 0, height_px = 0;
  double focal_x_px = 0.0, focal_y_px = 0.0;
  double center_u_px = 0.0, center_v_px = 0.0;

  /// Square pixels, centered axis. @param horizontal_fov_rad across the full width, in (0, pi).
  /// Throws std::invalid_argument for sizes below 1 or a field of view outside its range.
  static PinholeCamera from_fov(int width_px, int height_px, double horizontal_fov_rad);

  /// Pixel (u, v) of a point in C, m; nothing when the point is not in front of the camera. Not clipped to the image.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_C) const;
  /// Ray through a pixel, in C, scaled to z = 1.
  Eigen::Vector3d ray_at_unit_depth(const Eigen::Vector2d& pixel) const;
};

}  // namespace hedgehop::vision::camera
