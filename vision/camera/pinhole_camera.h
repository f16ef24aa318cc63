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

  /// Returns a camera with square pixels and a centered axis. @param horizontal_fov_rad  across the full width, in
  /// (0, pi). Throws std::invalid_argument for sizes below 1 or a field of view out of range.
  static PinholeCamera from_fov(int width_px, int height_px, double horizontal_fov_rad);

  /// Returns the pixel (u, v) of a point in C, m; std::nullopt if it is not in front of the camera. Not clipped to the
  /// image.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_C) const;
  /// Returns the ray through a pixel in C, scaled to z = 1.
  Eigen::Vector3d ray_at_unit_depth(const Eigen::Vector2d& pixel) const;
};

/// A perspective lens with Brown-Conrady distortion in the convention of OpenCV's calib3d module. With x = x_C / z_C,
/// y = y_C / z_C and r^2 = x^2 + y^2, the distorted x is
/// x (1 + k1 r^2 + k2 r^4 + k3 r^6) / (1 + k4 r^2 + k5 r^4 + k6 r^6) + 2 p1 x y + p2 (r^2 + 2 x^2), and y likewise with
/// p1 and p2 exchanged. The field of view ends at the radius at which the distorted radius stops increasing.
struct PinholeLens {
  double focal_x_px = 0.0, focal_y_px = 0.0;
  double center_u_px = 0.0, center_v_px = 0.0;
  double k1 = 0.0, k2 = 0.0, p1 = 0.0, p2 = 0.0, k3 = 0.0;
  double k4 = 0.0, k5 = 0.0, k6 = 0.0;  ///< of the rational model

  bool operator==(const PinholeLens&) const = default;
  /// Returns whether all coefficients are zero.
  bool is_undistorted() const { return *this == PinholeLens{focal_x_px, focal_y_px, center_u_px, center_v_px}; }
  bool is_rational() const { return k4 != 0.0 || k5 != 0.0 || k6 != 0.0; }

  /// As Camera::project().
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_C) const;
  /// As Camera::unit_ray().
  std::optional<Eigen::Vector3d> unit_ray(const Eigen::Vector2d& pixel) const;
};

}  // namespace hedgehop::vision::camera
