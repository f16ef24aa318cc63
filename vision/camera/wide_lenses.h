#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hedgehop::vision::camera {

/// Pixel of a point that a lens does not image.
inline const Eigen::Vector2d kNoPixel = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());

/// A fisheye lens, whose field of view may exceed 180 degrees. A ray at angle theta to the axis is imaged at
/// theta (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8) focal lengths from the center. With coefficients of
/// zero this is the equidistant projection. Coefficients as in OpenCV's fisheye module, after [KannalaBrandt2006].
struct FisheyeLens {
  double focal_x_px = 0.0, focal_y_px = 0.0;
  double center_u_px = 0.0, center_v_px = 0.0;
  double k1 = 0.0, k2 = 0.0, k3 = 0.0, k4 = 0.0;
  double limit_rad = std::numbers::pi;  ///< maximum angle off the axis; at most pi and growth_limit_rad()

  bool operator==(const FisheyeLens&) const = default;

  /// Returns the distance of a ray's pixel from the center, in focal lengths. Also defined beyond the limit.
  double radius(double angle_rad) const;
  /// Returns the derivative of radius().
  double radius_slope(double angle_rad) const;
  /// Returns the angle up to which the radius increases, at most pi, to 0.1 mrad.
  double growth_limit_rad() const;

  /// As Camera::project().
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_C) const;
  /// As Camera::project_each().
  void project_each(std::span<const Eigen::Vector3d> points_C, std::span<Eigen::Vector2d> pixels) const;
  /// As Camera::unit_ray().
  std::optional<Eigen::Vector3d> unit_ray(const Eigen::Vector2d& pixel) const;
};

/// Contents of an OCamCalib file (calib_results.txt) in its own convention, after [Scaramuzza2006]: x down the rows, y
/// along the columns, the optical axis along -z, pixel (0, 0) at the center of the top-left pixel.
/// [row - center_row, col - center_col] = [c d; e 1] [x, y], and the ray through (x, y) is (x, y, f(hypot(x, y))).
struct OcamCalibration {
  std::vector<double> direct;   ///< f, px, coefficients from power 0 up; f(0) < 0
  std::vector<double> inverse;  ///< hypot(x, y), px, from atan(z / hypot(x, y)); a fit that OcamLens ignores
  double center_row_px = 0.0, center_col_px = 0.0;
  double c = 1.0, d = 0.0, e = 0.0;
  int height_px = 0, width_px = 0;
};

/// Returns the calibration in the text of an OCamCalib file. Lines that begin with # are comments. The file has five
/// rows of numbers; the rows of the polynomials begin with the number of their coefficients. Throws
/// std::invalid_argument with the reason if the text is invalid.
OcamCalibration parse_ocam_calibration(const std::string& text);

/// The omnidirectional lens of an OcamCalibration, whose field of view may exceed 180 degrees. Expressed in frame C:
/// x_C is the calibration's y, y_C its x, z_C its -z.
struct OcamLens {
  static constexpr size_t kMaxCoefficients = 12;

  std::array<double, kMaxCoefficients> direct{};  ///< f, px, from power 0 up
  double center_row_px = 0.0, center_col_px = 0.0;
  double c = 1.0, d = 0.0, e = 0.0;
  double limit_px = 0.0;  ///< maximum of hypot(x, y); the angle off the axis increases up to it

  bool operator==(const OcamLens&) const = default;

  /// Returns the angle off the axis, rad, of the ray through a point at this distance from the center.
  double angle_rad(double radius_px) const;

  /// As Camera::project(). Solves the direct polynomial, so that it inverts unit_ray() up to rounding.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_C) const;
  /// As Camera::unit_ray().
  std::optional<Eigen::Vector3d> unit_ray(const Eigen::Vector2d& pixel) const;
};

/// Returns the lens of a calibration. Its limit is the distance of the outermost image corner from the center, or the
/// radius at which the angle off the axis stops increasing. Throws std::invalid_argument if the calibration is
/// inconsistent.
OcamLens ocam_lens(const OcamCalibration& calibration);

}  // namespace hedgehop::vision::camera
