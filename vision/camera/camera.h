#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "vision/camera/pinhole_camera.h"
#include "vision/camera/sphere_lenses.h"
#include "vision/camera/wide_lenses.h"

namespace hedgehop::vision::camera {

/// A camera: its image size and its lens. Frame C: x right, y down, z forward along the optical axis. Pixel (0, 0) is
/// the center of the top-left pixel, u right, v down, so an image covers u in [-0.5, width - 0.5]. The simulator
/// renders images with this projection. Copying a camera does not allocate memory.
struct Camera {
  using Lens = std::variant<PinholeLens, FisheyeLens, OcamLens, UnifiedLens, DoubleSphereLens>;

  int width_px = 0, height_px = 0;
  Lens lens;

  Camera() = default;
  Camera(int width, int height, const Lens& its_lens) : width_px(width), height_px(height), lens(its_lens) {}
  /// A pinhole camera. Implicit, so that a PinholeCamera can be passed as a Camera.
  Camera(const PinholeCamera& pinhole);
  /// Throws std::invalid_argument like ocam_lens().
  explicit Camera(const OcamCalibration& calibration);

  bool operator==(const Camera&) const = default;

  /// Returns the pixel (u, v) of a point in C, m; std::nullopt beyond the lens's limit. Not clipped to the image.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_C) const;
  /// Returns the pixel of each point as project() does, faster for some lenses; kNoPixel instead of std::nullopt.
  std::vector<Eigen::Vector2d> project_each(std::span<const Eigen::Vector3d> points_C) const;
  /// Returns the ray through a pixel in C, of length 1; std::nullopt outside the lens's image circle. Inverse of
  /// project().
  std::optional<Eigen::Vector3d> unit_ray(const Eigen::Vector2d& pixel) const;

  /// Returns whether the lens is an undistorted pinhole, which images straight lines as straight lines.
  bool is_undistorted_pinhole() const;
  /// Returns this camera as an undistorted pinhole, for algorithms that require one.
  /// Throws std::invalid_argument with the name of the lens if it is a different one.
  PinholeCamera pinhole() const;
  /// Returns "pinhole", "distorted pinhole", "fisheye", "omnidirectional (OCamCalib)", "unified" or "double sphere".
  std::string lens_name() const;
};

/// Returns the focal length, px, at which a fisheye with these coefficients images a field of view across the full
/// width.
/// @param horizontal_fov_rad  in (0, 2 pi). Throws std::invalid_argument if it exceeds the lens's limit.
double fisheye_focal_px(const FisheyeLens& coefficients, int width_px, double horizontal_fov_rad);

/// Returns the share of an image's pixels that show no ray because the distortion polynomial of a pinhole, unified or
/// fisheye lens turns over before them; estimated on a grid of at most 64 x 64 pixels. They stay black.
double share_past_turn(const Camera& camera);

/// Throws std::invalid_argument with the reason if the camera is invalid: an empty image, a focal length that is not
/// positive, a number that is not finite, a limit in the range in which the image radius decreases, or an image circle
/// smaller than a pixel.
void check(const Camera& camera);

}  // namespace hedgehop::vision::camera
