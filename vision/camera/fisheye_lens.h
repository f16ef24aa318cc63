#pragma once

#include <Eigen/Core>
#include <numbers>
#include <optional>

namespace hedgehop::vision::camera {

/// A lens that may see behind itself: a ray at angle theta to the axis is imaged
/// theta (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8) focal lengths from the center, the equidistant
/// projection when all four are zero. Coefficients as in OpenCV's fisheye module, after [KannalaBrandt2006].
struct FisheyeLens {
  double focal_x_px = 0.0, focal_y_px = 0.0;
  double center_u_px = 0.0, center_v_px = 0.0;
  double k1 = 0.0, k2 = 0.0, k3 = 0.0, k4 = 0.0;
  double limit_rad =
      std::numbers::pi;  ///< off the axis; nothing is seen from there on; at most pi and growth_limit_rad()

  bool operator==(const FisheyeLens&) const = default;

  /// Distance of a ray's pixel from the center, in focal lengths, and its derivative; defined beyond the limit, too.
  double radius(double angle_rad) const;
  double radius_slope(double angle_rad) const;
  /// Angle up to which the radius grows, at most pi, to 0.1 mrad.
  double growth_limit_rad() const;

  /// As Camera::project().
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_C) const;
  /// As Camera::unit_ray().
  std::optional<Eigen::Vector3d> unit_ray(const Eigen::Vector2d& pixel) const;
};

}  // namespace hedgehop::vision::camera
