#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "vision/camera/pinhole_camera.h"
#include "vision/flow/flow_field.h"

/// Exact flow of points on a plane, by projecting them before and after a camera's finite motion.
namespace hedgehop::vision {

/// Returns a field of evenly spaced valid vectors without flow, at least `rim_px` from the image's border.
inline flow::FlowField grid_field(int rows, int cols, double rim_px, int size_px) {
  flow::FlowField field;
  field.rows = rows;
  field.cols = cols;
  const double span = size_px - 1 - 2 * rim_px;
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      field.vectors.push_back(
          {{rim_px + span * col / (cols - 1.0), rim_px + span * row / (rows - 1.0)}, {0.0, 0.0}, true});
    }
  }
  return field;
}

/// @param field  positions of the flow vectors; invalid vectors are not changed.
/// @param on_plane_C, normal_C  the plane in the camera frame before the motion, m.
/// @param v_WC_C, w_WC_C  constant in the camera frame before the motion, m/s and rad/s.
inline flow::FlowField plane_flow(const camera::PinholeCamera& camera, flow::FlowField field,
                                  const Eigen::Vector3d& on_plane_C, const Eigen::Vector3d& normal_C,
                                  const Eigen::Vector3d& v_WC_C, const Eigen::Vector3d& w_WC_C, double dt_s) {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.translation() = v_WC_C * dt_s;
  if (w_WC_C.norm() > 0.0) motion.rotate(Eigen::AngleAxisd(w_WC_C.norm() * dt_s, w_WC_C.normalized()));
  for (flow::FlowVector& vector : field.vectors) {
    if (!vector.valid) continue;
    const Eigen::Vector3d ray = camera.ray_at_unit_depth(vector.center_px);
    const Eigen::Vector3d p = ray * (normal_C.dot(on_plane_C) / normal_C.dot(ray));
    vector.flow_px = camera.project(motion.inverse() * p).value() - vector.center_px;
  }
  return field;
}

}  // namespace hedgehop::vision
