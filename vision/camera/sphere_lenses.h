#pragma once

#include <Eigen/Core>
#include <optional>

#include "vision/camera/pinhole_camera.h"

namespace hedgehop::vision::camera {

/// An omnidirectional lens after [MeiRives2007]: the ray of unit length is moved by xi along the axis, divided by its
/// depth, and distorted and imaged as by a pinhole. With xi = 0 it is that pinhole. Kalibr: omni with radtan; OpenCV:
/// module omnidir, without skew.
struct UnifiedLens {
  PinholeLens plane;  ///< images the plane z = 1 of the moved ray; without the rational coefficients
  double xi = 0.0;    ///< >= 0

  bool operator==(const UnifiedLens&) const = default;

  /// As Camera::project().
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_C) const;
  /// As Camera::unit_ray().
  std::optional<Eigen::Vector3d> unit_ray(const Eigen::Vector2d& pixel) const;
};

/// The double-sphere lens, after [UsenkoDemmelCremers2018]. Kalibr: ds.
struct DoubleSphereLens {
  double focal_x_px = 0.0, focal_y_px = 0.0;
  double center_u_px = 0.0, center_v_px = 0.0;
  double xi = 0.0;     ///< distance between the spheres, > -1
  double alpha = 0.0;  ///< in [0, 1)

  bool operator==(const DoubleSphereLens&) const = default;

  /// As Camera::project().
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_C) const;
  /// As Camera::unit_ray().
  std::optional<Eigen::Vector3d> unit_ray(const Eigen::Vector2d& pixel) const;

 private:
  bool sees(const Eigen::Vector3d& ray_C) const;
};

}  // namespace hedgehop::vision::camera
