#pragma once

#include <Eigen/Core>
#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

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

/// What an OCamCalib file holds (calib_results.txt), in its own convention: x down the rows, y along the columns, the
/// optical axis along -z, pixel (0, 0) the center of the top-left one; after [Scaramuzza2006].
/// [row - center_row, col - center_col] = [c d; e 1] [x, y], and the ray through (x, y) is (x, y, f(hypot(x, y))).
struct OcamCalibration {
  std::vector<double> direct;   ///< f, px, coefficients from power 0 up; f(0) < 0
  std::vector<double> inverse;  ///< hypot(x, y), px, from atan(z / hypot(x, y)); a fit, which OcamLens does without
  double center_row_px = 0.0, center_col_px = 0.0;
  double c = 1.0, d = 0.0, e = 0.0;
  int height_px = 0, width_px = 0;
};

/// @param text  of the file: lines that begin with # are comments; five rows of numbers, polynomials with their count
/// in front. Throws std::invalid_argument, saying what is wrong, for anything else.
OcamCalibration parse_ocam_calibration(const std::string& text);

/// The omnidirectional lens of an OcamCalibration, which may see behind itself. It turns to frame C: x_C is its y, y_C
/// its x, z_C its -z.
struct OcamLens {
  static constexpr size_t kMaxCoefficients = 12;

  std::array<double, kMaxCoefficients> direct{};  ///< f, px, from power 0 up
  double center_row_px = 0.0, center_col_px = 0.0;
  double c = 1.0, d = 0.0, e = 0.0;
  double limit_px = 0.0;  ///< hypot(x, y) from where on nothing is seen; the angle off the axis grows up to there

  bool operator==(const OcamLens&) const = default;

  /// Angle off the axis of the ray through a point so far from the center, rad.
  double angle_rad(double radius_px) const;

  /// As Camera::project(). Solves the direct polynomial, so that it is the inverse of unit_ray() to rounding.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_C) const;
  /// As Camera::unit_ray().
  std::optional<Eigen::Vector3d> unit_ray(const Eigen::Vector2d& pixel) const;
};

/// Sees as far as the image's farthest corner, or to where the angle off the axis stops growing. Throws
/// std::invalid_argument for a calibration that contradicts itself.
OcamLens ocam_lens(const OcamCalibration& calibration);

}  // namespace hedgehop::vision::camera
