#include "vision/camera/pinhole_camera.h"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

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
  // Half the image width, up to the outer edge of the last pixel, covers half the field of view.
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

namespace {

/// A distorted point of the plane z = 1, and the Jacobian of the distortion there.
struct Distorted {
  Eigen::Vector2d point;
  Eigen::Matrix2d slope;
};

/// Returns the radial factor at r^2 = s, and its derivative with s.
std::pair<double, double> stretch_of(const PinholeLens& lens, double s) {
  const double above = 1.0 + s * (lens.k1 + s * (lens.k2 + s * lens.k3));
  const double d_above = lens.k1 + s * (2.0 * lens.k2 + s * 3.0 * lens.k3);
  if (!lens.is_rational()) return {above, d_above};
  const double below = 1.0 + s * (lens.k4 + s * (lens.k5 + s * lens.k6));
  const double d_below = lens.k4 + s * (2.0 * lens.k5 + s * 3.0 * lens.k6);
  return {above / below, (d_above * below - above * d_below) / (below * below)};
}

/// Returns whether the radial part of a rational lens increases up to r^2 = `end`.
bool grows_to(const PinholeLens& lens, double end) {
  constexpr int kSamples = 64;
  for (int sample = 1; sample <= kSamples; ++sample) {
    const double s = end * sample / kSamples;
    const auto [stretch, d_stretch] = stretch_of(lens, s);
    const double below = 1.0 + s * (lens.k4 + s * (lens.k5 + s * lens.k6));
    if (!(below > 0.0 && stretch + 2.0 * s * d_stretch > 0.0)) return false;
  }
  return true;
}

Distorted distort(const PinholeLens& lens, const Eigen::Vector2d& p) {
  const double x = p.x(), y = p.y(), s = p.squaredNorm();
  const auto [stretch, d_stretch] = stretch_of(lens, s);
  const Eigen::Vector2d tangential(2.0 * lens.p1 * x * y + lens.p2 * (s + 2.0 * x * x),
                                   lens.p1 * (s + 2.0 * y * y) + 2.0 * lens.p2 * x * y);
  Eigen::Matrix2d slope = stretch * Eigen::Matrix2d::Identity() + 2.0 * d_stretch * p * p.transpose();
  const double across = 2.0 * (lens.p1 * x + lens.p2 * y);
  slope(0, 0) += 2.0 * lens.p1 * y + 6.0 * lens.p2 * x;
  slope(0, 1) += across;
  slope(1, 0) += across;
  slope(1, 1) += 6.0 * lens.p1 * y + 2.0 * lens.p2 * x;
  return {stretch * p + tangential, slope};
}

/// Returns whether the radial part increases up to `p` and the Jacobian is positive at `p`, so that the pixel has a
/// unique ray.
bool is_in_view(const PinholeLens& lens, const Eigen::Vector2d& p, const Eigen::Matrix2d& slope) {
  const double end = p.squaredNorm();
  if (lens.is_rational()) return grows_to(lens, end) && slope.determinant() > 0.0;
  // The growth d(r (1 + ...)) / dr is a cubic in s = r^2. Its minimum is at an end of [0, end] or a root of its slope.
  const auto growth = [&](double s) { return 1.0 + s * (3.0 * lens.k1 + s * (5.0 * lens.k2 + s * 7.0 * lens.k3)); };
  const double a = 21.0 * lens.k3, b = 10.0 * lens.k2, c = 3.0 * lens.k1, root = std::sqrt(b * b - 4.0 * a * c);
  const std::array<double, 3> turns = {(-b + root) / (2.0 * a), (-b - root) / (2.0 * a), -c / b};
  if (!(growth(end) > 0.0)) return false;
  for (const double s : turns) {
    if (s > 0.0 && s < end && !(growth(s) > 0.0)) return false;
  }
  return slope.determinant() > 0.0;
}

/// Returns the point that the lens distorts to `seen`; std::nullopt if there is none.
std::optional<Eigen::Vector2d> straighten(const PinholeLens& lens, const Eigen::Vector2d& seen) {
  constexpr int kMaxSteps = 60;
  constexpr double kAccuracy = 1e-14;
  Eigen::Vector2d p = seen;
  Distorted at = distort(lens, p);
  // Beyond the turn of the polynomial, Newton's step leads away. A smaller radius is before the turn.
  while (!(at.slope.determinant() > 0.0) && p.norm() > 1e-3) at = distort(lens, p *= 0.5);
  for (int step = 0; step < kMaxSteps; ++step) {
    const double error = (at.point - seen).norm();
    if (error <= kAccuracy * (1.0 + seen.norm())) break;
    // Newton's step, halved until the error decreases.
    Eigen::Vector2d move = at.slope.inverse() * (seen - at.point);
    for (int halving = 0; halving < 30; ++halving, move *= 0.5) {
      const Distorted next = distort(lens, p + move);
      if (!((next.point - seen).norm() < error) || !(next.slope.determinant() > 0.0)) continue;
      p += move;
      at = next;
      break;
    }
    if (!((at.point - seen).norm() < error)) break;  // at the limit of rounding
  }
  constexpr double kFound = 1e-11;
  if (!((at.point - seen).norm() <= kFound * (1.0 + seen.norm())) || !is_in_view(lens, p, at.slope))
    return std::nullopt;
  return p;
}

}  // namespace

std::optional<Eigen::Vector2d> PinholeLens::project(const Eigen::Vector3d& p_C) const {
  if (!(p_C.z() > 0.0)) return std::nullopt;
  Eigen::Vector2d p = p_C.head<2>() / p_C.z();
  if (!is_undistorted()) {
    const Distorted at = distort(*this, p);
    if (!is_in_view(*this, p, at.slope)) return std::nullopt;
    p = at.point;
  }
  return Eigen::Vector2d{center_u_px + focal_x_px * p.x(), center_v_px + focal_y_px * p.y()};
}

std::optional<Eigen::Vector3d> PinholeLens::unit_ray(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d seen((pixel.x() - center_u_px) / focal_x_px, (pixel.y() - center_v_px) / focal_y_px);
  const std::optional<Eigen::Vector2d> p = is_undistorted() ? seen : straighten(*this, seen);
  if (!p) return std::nullopt;
  return Eigen::Vector3d(p->x(), p->y(), 1.0).normalized();
}

}  // namespace hedgehop::vision::camera
