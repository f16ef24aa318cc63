#include "sim/scenario/mounting.h"

#include <cmath>

#include "sim/libm/random.h"

namespace hedgehop::sim {

double pixel_angle_rad(const vision::camera::Camera& camera) {
  const Eigen::Vector3d axis_C = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d below_C = *camera.unit_ray(*camera.project(axis_C) + Eigen::Vector2d(0.0, 1.0));
  return std::atan2(axis_C.cross(below_C).norm(), axis_C.dot(below_C));
}

Eigen::Isometry3d true_X_BC(const CameraConfig& camera, const vision::camera::Camera& model, uint64_t seed) {
  if (camera.row_error_px == 0.0 && camera.side_error_m == 0.0) return camera.X_BC();
  const uint64_t bits = stream_seed(seed, "calibration." + camera.role);
  const double row_sign = (bits & 1U) != 0 ? 1.0 : -1.0, side_sign = (bits & 2U) != 0 ? 1.0 : -1.0;
  const double turn_rad = row_sign * camera.row_error_px * pixel_angle_rad(model);
  return camera.X_BC() * Eigen::Translation3d(side_sign * camera.side_error_m, 0.0, 0.0) *
         Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitX());
}

}  // namespace hedgehop::sim
