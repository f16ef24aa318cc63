#include "vision/camera/sphere_lenses.h"

#include <cmath>

namespace hedgehop::vision::camera {

std::optional<Eigen::Vector2d> UnifiedLens::project(const Eigen::Vector3d& p_C) const {
  const double distance = p_C.norm();
  if (!(distance > 0.0)) return std::nullopt;
  // Beyond this angle a second ray has the same pixel.
  const double min_z = xi > 1.0 ? -1.0 / xi : -xi;
  const Eigen::Vector3d moved = p_C / distance + xi * Eigen::Vector3d::UnitZ();
  if (!(p_C.z() > min_z * distance)) return std::nullopt;
  return plane.project(moved);
}

std::optional<Eigen::Vector3d> UnifiedLens::unit_ray(const Eigen::Vector2d& pixel) const {
  const std::optional<Eigen::Vector3d> moved = plane.unit_ray(pixel);
  if (!moved) return std::nullopt;
  // The intersection of moved * k with the unit sphere around (0, 0, xi).
  const double z = moved->z(), discriminant = 1.0 - xi * xi * (1.0 - z * z);
  if (!(discriminant > 0.0)) return std::nullopt;
  const double k = xi * z + std::sqrt(discriminant);
  return (k * *moved - xi * Eigen::Vector3d::UnitZ()).normalized();
}

bool DoubleSphereLens::sees(const Eigen::Vector3d& ray_C) const {
  const double w1 = alpha > 0.5 ? (1.0 - alpha) / alpha : alpha / (1.0 - alpha);
  const double w2 = (w1 + xi) / std::sqrt(2.0 * w1 * xi + xi * xi + 1.0);
  return ray_C.z() > -w2;
}

std::optional<Eigen::Vector2d> DoubleSphereLens::project(const Eigen::Vector3d& p_C) const {
  const double distance = p_C.norm();
  if (!(distance > 0.0)) return std::nullopt;
  const Eigen::Vector3d ray_C = p_C / distance;
  if (!sees(ray_C)) return std::nullopt;
  const double z = ray_C.z() + xi;
  const double depth = alpha * std::sqrt(ray_C.head<2>().squaredNorm() + z * z) + (1.0 - alpha) * z;
  if (!(depth > 0.0)) return std::nullopt;
  return Eigen::Vector2d{center_u_px + focal_x_px * ray_C.x() / depth, center_v_px + focal_y_px * ray_C.y() / depth};
}

std::optional<Eigen::Vector3d> DoubleSphereLens::unit_ray(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d m((pixel.x() - center_u_px) / focal_x_px, (pixel.y() - center_v_px) / focal_y_px);
  const double s = m.squaredNorm(), inner = 1.0 - (2.0 * alpha - 1.0) * s;
  if (!(inner > 0.0)) return std::nullopt;
  const double m_z = (1.0 - alpha * alpha * s) / (alpha * std::sqrt(inner) + 1.0 - alpha);
  const double outer = m_z * m_z + (1.0 - xi * xi) * s;
  if (!(outer > 0.0)) return std::nullopt;
  const double k = (m_z * xi + std::sqrt(outer)) / (m_z * m_z + s);
  const Eigen::Vector3d ray_C = Eigen::Vector3d(k * m.x(), k * m.y(), k * m_z - xi).normalized();
  return sees(ray_C) ? std::optional(ray_C) : std::nullopt;
}

}  // namespace hedgehop::vision::camera
