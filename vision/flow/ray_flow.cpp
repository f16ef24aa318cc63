#include "vision/flow/ray_flow.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

namespace hedgehop::vision::flow {

Eigen::Vector3d derotate_ray(const Eigen::Vector3d& after_C, const Eigen::Matrix3d& R_C1C2) { return R_C1C2 * after_C; }

double flow_angle_rad(const Eigen::Vector3d& before, const Eigen::Vector3d& after) {
  return std::atan2(before.cross(after).norm(), before.dot(after));
}

double distance_m(const Eigen::Vector3d& before, const Eigen::Vector3d& after, const Eigen::Vector3d& traveled) {
  const double sin_flow = before.cross(after).norm();
  const double across_m = before.cross(traveled).norm();  // v dt sin(alpha)
  return sin_flow > 0.0 ? across_m / sin_flow : std::numeric_limits<double>::infinity();
}

double direction_error_rad(const Eigen::Vector3d& before, const Eigen::Vector3d& after,
                           const Eigen::Vector3d& traveled) {
  const Eigen::Vector3d moved = after - after.dot(before) * before;
  const Eigen::Vector3d fixed = traveled.dot(before) * before - traveled;
  if (moved.norm() == 0.0 || fixed.norm() == 0.0) return std::numbers::pi / 2.0;
  return flow_angle_rad(moved, fixed);
}

double off_tangent_rad(const Eigen::Vector2d& before_px, const Eigen::Vector2d& after_px,
                       const Eigen::Vector2d& center_px) {
  const Eigen::Vector2d radius = before_px - center_px, flow = after_px - before_px;
  if (flow.norm() == 0.0) return std::numbers::pi / 2.0;
  const double along = std::abs(radius.dot(flow)), across = std::abs(radius.x() * flow.y() - radius.y() * flow.x());
  return std::atan2(along, across);
}

}  // namespace hedgehop::vision::flow
