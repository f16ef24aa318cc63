#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <variant>

#include "vision/camera/pinhole_camera.h"
#include "vision/camera/wide_lenses.h"

namespace hedgehop::vision::camera {

/// Any camera: the size of its images and its lens. Frame C: x right, y down, z forward along the optical axis. Pixel
/// (0, 0) is the center of the top-left pixel, u right, v down, so an image covers u in [-0.5, width - 0.5].
/// What it projects is what the simulator draws. A value: copying it allocates nothing.
struct Camera {
  using Lens = std::variant<PinholeLens, FisheyeLens, OcamLens>;

  int width_px = 0, height_px = 0;
  Lens lens;

  Camera() = default;
  Camera(int width, int height, const Lens& its_lens) : width_px(width), height_px(height), lens(its_lens) {}
  /// A pinhole camera. Not explicit, so that it can stand wherever a camera is expected.
  Camera(const PinholeCamera& pinhole);
  /// Throws std::invalid_argument as ocam_lens().
  explicit Camera(const OcamCalibration& calibration);

  bool operator==(const Camera&) const = default;

  /// Pixel (u, v) of a point in C, m; nothing beyond the lens's limit. Not clipped to the image.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_C) const;
  /// Ray through a pixel, in C, of length 1; nothing where the lens shows nothing. The inverse of project().
  std::optional<Eigen::Vector3d> unit_ray(const Eigen::Vector2d& pixel) const;

  /// Whether the lens is an undistorted pinhole, which shows straight lines as straight lines.
  bool is_undistorted_pinhole() const;
  /// This camera as an undistorted pinhole, for algorithms that hold for no other lens.
  /// Throws std::invalid_argument, naming the lens, when it is another.
  PinholeCamera pinhole() const;
  /// "pinhole", "distorted pinhole", "fisheye" or "omnidirectional (OCamCalib)".
  std::string lens_name() const;
};

/// Focal length at which a fisheye of these coefficients shows a field of view across an image's full width, px.
/// @param horizontal_fov_rad  in (0, 2 pi). Throws std::invalid_argument when the lens does not reach so far.
double fisheye_focal_px(const FisheyeLens& coefficients, int width_px, double horizontal_fov_rad);

/// Throws std::invalid_argument, naming the fault, for a camera that cannot be: without pixels, with a focal length
/// that is not positive, a number that is not finite, or a limit beyond which its lens folds back.
void check(const Camera& camera);

}  // namespace hedgehop::vision::camera
