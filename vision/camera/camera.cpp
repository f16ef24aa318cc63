#include "vision/camera/camera.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>

namespace hedgehop::vision::camera {

namespace {

void require(bool holds, const char* fault) {
  if (!holds) throw std::invalid_argument(fault);
}

bool finite(std::initializer_list<double> numbers) {
  for (const double number : numbers) {
    if (!std::isfinite(number)) return false;
  }
  return true;
}

// Takes `const char*`, because this check runs for every image and must not allocate.
void check_lens(const PinholeLens& lens) {
  require(finite({lens.focal_x_px, lens.focal_y_px, lens.center_u_px, lens.center_v_px, lens.k1, lens.k2, lens.p1,
                  lens.p2, lens.k3, lens.k4, lens.k5, lens.k6}),
          "a number of the lens is not finite");
  require(lens.focal_x_px > 0.0 && lens.focal_y_px > 0.0, "a camera's focal lengths must be positive");
}

void check_lens(const FisheyeLens& lens) {
  require(finite({lens.focal_x_px, lens.focal_y_px, lens.center_u_px, lens.center_v_px, lens.k1, lens.k2, lens.k3,
                  lens.k4, lens.limit_rad}),
          "a number of the lens is not finite");
  require(lens.focal_x_px > 0.0 && lens.focal_y_px > 0.0, "a camera's focal lengths must be positive");
  const double growth_limit_rad = lens.growth_limit_rad();
  if (!(lens.limit_rad > 0.0 && lens.limit_rad <= growth_limit_rad)) {
    throw std::invalid_argument("a fisheye cannot see " + std::to_string(lens.limit_rad) +
                                " rad off its axis: its distortion folds back at " + std::to_string(growth_limit_rad) +
                                " rad");
  }
}

void check_lens(const OcamLens& lens) {
  for (const double coefficient : lens.direct) require(std::isfinite(coefficient), "a coefficient is not finite");
  require(finite({lens.center_row_px, lens.center_col_px, lens.c, lens.d, lens.e, lens.limit_px}),
          "a number of the lens is not finite");
  require(lens.limit_px > 0.0, "an omnidirectional lens needs a limit above 0 px");
}

void check_lens(const UnifiedLens& lens) {
  check_lens(lens.plane);
  require(std::isfinite(lens.xi) && lens.xi >= 0.0, "xi of a unified lens must be at least 0");
}

void check_lens(const DoubleSphereLens& lens) {
  require(finite({lens.focal_x_px, lens.focal_y_px, lens.center_u_px, lens.center_v_px, lens.xi, lens.alpha}),
          "a number of the lens is not finite");
  require(lens.focal_x_px > 0.0 && lens.focal_y_px > 0.0, "a camera's focal lengths must be positive");
  require(lens.xi > -1.0, "xi of a double-sphere lens must be above -1");
  require(lens.alpha >= 0.0 && lens.alpha < 1.0, "alpha of a double-sphere lens must be in [0, 1)");
}

/// Whether pixels without a ray are past the turn of the lens's polynomial, not past a limit of its geometry.
bool can_turn(const Camera::Lens& lens) {
  if (const auto* pinhole = std::get_if<PinholeLens>(&lens)) return !pinhole->is_undistorted();
  if (const auto* unified = std::get_if<UnifiedLens>(&lens)) return !unified->plane.is_undistorted();
  const auto* const fisheye = std::get_if<FisheyeLens>(&lens);
  return fisheye && fisheye->limit_rad < std::numbers::pi && fisheye->limit_rad == fisheye->growth_limit_rad();
}

}  // namespace

double share_past_turn(const Camera& camera) {
  if (!can_turn(camera.lens)) return 0.0;
  constexpr int kNodes = 64;
  const int columns = std::min(kNodes, camera.width_px), rows = std::min(kNodes, camera.height_px);
  int past = 0;
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < columns; ++col) {
      const Eigen::Vector2d pixel((col + 0.5) / columns * camera.width_px - 0.5,
                                  (row + 0.5) / rows * camera.height_px - 0.5);
      if (!camera.unit_ray(pixel)) ++past;
    }
  }
  return static_cast<double>(past) / (rows * columns);
}

Camera::Camera(const PinholeCamera& pinhole)
    : width_px(pinhole.width_px),
      height_px(pinhole.height_px),
      lens(PinholeLens{pinhole.focal_x_px, pinhole.focal_y_px, pinhole.center_u_px, pinhole.center_v_px}) {}

Camera::Camera(const OcamCalibration& calibration)
    : width_px(calibration.width_px), height_px(calibration.height_px), lens(ocam_lens(calibration)) {}

std::optional<Eigen::Vector2d> Camera::project(const Eigen::Vector3d& p_C) const {
  return std::visit([&](const auto& its_lens) { return its_lens.project(p_C); }, lens);
}

std::vector<Eigen::Vector2d> Camera::project_each(std::span<const Eigen::Vector3d> points_C) const {
  std::vector<Eigen::Vector2d> pixels(points_C.size(), kNoPixel);
  const auto project_by = [&](const auto& its_lens) {
    if constexpr (requires { its_lens.project_each(points_C, pixels); }) {
      its_lens.project_each(points_C, pixels);
    } else {
      for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = its_lens.project(points_C[i]).value_or(kNoPixel);
    }
  };
  std::visit(project_by, lens);
  return pixels;
}

std::optional<Eigen::Vector3d> Camera::unit_ray(const Eigen::Vector2d& pixel) const {
  return std::visit([&](const auto& its_lens) { return its_lens.unit_ray(pixel); }, lens);
}

bool Camera::is_undistorted_pinhole() const {
  const auto* const pinhole_lens = std::get_if<PinholeLens>(&lens);
  return pinhole_lens != nullptr && pinhole_lens->is_undistorted();
}

PinholeCamera Camera::pinhole() const {
  if (!is_undistorted_pinhole()) {
    throw std::invalid_argument("needs an undistorted pinhole camera, got a " + lens_name());
  }
  const auto& pinhole_lens = std::get<PinholeLens>(lens);
  return {width_px,
          height_px,
          pinhole_lens.focal_x_px,
          pinhole_lens.focal_y_px,
          pinhole_lens.center_u_px,
          pinhole_lens.center_v_px};
}

std::string Camera::lens_name() const {
  if (std::holds_alternative<FisheyeLens>(lens)) return "fisheye";
  if (std::holds_alternative<OcamLens>(lens)) return "omnidirectional (OCamCalib)";
  if (std::holds_alternative<UnifiedLens>(lens)) return "unified";
  if (std::holds_alternative<DoubleSphereLens>(lens)) return "double sphere";
  return is_undistorted_pinhole() ? "pinhole" : "distorted pinhole";
}

double fisheye_focal_px(const FisheyeLens& coefficients, int width_px, double horizontal_fov_rad) {
  const double half_rad = 0.5 * horizontal_fov_rad;
  if (!(half_rad > 0.0 && half_rad <= coefficients.growth_limit_rad() && half_rad < std::numbers::pi)) {
    throw std::invalid_argument("a fisheye of these coefficients cannot show " + std::to_string(horizontal_fov_rad) +
                                " rad across");
  }
  return 0.5 * width_px / coefficients.radius(half_rad);
}

void check(const Camera& camera) {
  if (camera.width_px < 1 || camera.height_px < 1) {
    throw std::invalid_argument("a camera's image needs at least one pixel each way, got " +
                                std::to_string(camera.width_px) + " x " + std::to_string(camera.height_px));
  }
  std::visit([](const auto& lens) { check_lens(lens); }, camera.lens);
  const std::optional<Eigen::Vector2d> center = camera.project(Eigen::Vector3d::UnitZ());
  if (center && !camera.unit_ray(*center + Eigen::Vector2d::UnitY())) {
    throw std::invalid_argument("the image circle is smaller than a pixel");
  }
}

}  // namespace hedgehop::vision::camera
