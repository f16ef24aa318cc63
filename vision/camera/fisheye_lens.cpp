#include "vision/camera/fisheye_lens.h"

#include <cmath>
#include <utility>

#include "vision/camera/rising_root.h"

namespace hedgehop::vision::camera {

double FisheyeLens::radius(double angle_rad) const {
  const double s = angle_rad * angle_rad;
  return angle_rad * (1.0 + s * (k1 + s * (k2 + s * (k3 + s * k4))));
}

double FisheyeLens::radius_slope(double angle_rad) const {
  const double s = angle_rad * angle_rad;
  return 1.0 + s * (3.0 * k1 + s * (5.0 * k2 + s * (7.0 * k3 + s * 9.0 * k4)));
}

double FisheyeLens::growth_limit_rad() const {
  constexpr double kStepRad = 1e-4;
  double angle_rad = 0.0;
  while (angle_rad < std::numbers::pi && radius_slope(angle_rad + kStepRad) > 0.0) angle_rad += kStepRad;
  return std::fmin(angle_rad, std::numbers::pi);
}

std::optional<Eigen::Vector2d> FisheyeLens::project(const Eigen::Vector3d& p_C) const {
  const double aside = p_C.head<2>().norm();
  const double angle_rad = std::atan2(aside, p_C.z());
  if (!(angle_rad < limit_rad) || !(p_C.squaredNorm() > 0.0)) return std::nullopt;
  if (aside == 0.0) return Eigen::Vector2d{center_u_px, center_v_px};
  const double scale = radius(angle_rad) / aside;
  return Eigen::Vector2d{center_u_px + focal_x_px * scale * p_C.x(), center_v_px + focal_y_px * scale * p_C.y()};
}

std::optional<Eigen::Vector3d> FisheyeLens::unit_ray(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d seen((pixel.x() - center_u_px) / focal_x_px, (pixel.y() - center_v_px) / focal_y_px);
  const double seen_radius = seen.norm();
  if (!(seen_radius < radius(limit_rad))) return std::nullopt;
  if (seen_radius == 0.0) return Eigen::Vector3d::UnitZ();
  const double angle_rad = rising_root([&](double a) { return std::pair(radius(a) - seen_radius, radius_slope(a)); },
                                       0.0, limit_rad, seen_radius);
  const Eigen::Vector2d aside = seen * (std::sin(angle_rad) / seen_radius);
  return Eigen::Vector3d(aside.x(), aside.y(), std::cos(angle_rad)).normalized();
}

}  // namespace hedgehop::vision::camera
