#include "vision/flow/flow_measures.h"

#include <Eigen/Geometry>

namespace hedgehop::vision::flow {

Eigen::Matrix<double, 2, 6> image_jacobian(const camera::PinholeCamera& camera, const Eigen::Vector2d& pixel,
                                           double depth_m) {
  const double U = pixel.x() - camera.center_u_px, V = pixel.y() - camera.center_v_px;
  const double f_x = camera.focal_x_px, f_y = camera.focal_y_px;
  const double near = 1.0 / depth_m;
  Eigen::Matrix<double, 2, 6> J;
  J << -f_x * near, 0.0, U * near, U * V / f_y, -(f_x + U * U / f_x), f_x / f_y * V,  //
      0.0, -f_y * near, V * near, f_y + V * V / f_y, -U * V / f_x, -f_y / f_x * U;
  return J;
}

Eigen::Vector2d rotation_flow_px(const camera::PinholeCamera& camera, const Eigen::Vector2d& pixel,
                                 const Eigen::Vector3d& w_WC_C, double dt_s) {
  const double angle_rad = w_WC_C.norm() * dt_s;
  if (angle_rad == 0.0) return Eigen::Vector2d::Zero();
  // A direction fixed in W rotates backward in C.
  const Eigen::AngleAxisd backwards(-angle_rad, w_WC_C.normalized());
  const auto moved = camera.project(backwards * camera.ray_at_unit_depth(pixel));
  return moved ? Eigen::Vector2d(*moved - pixel)
               : Eigen::Vector2d(image_jacobian(camera, pixel, 1.0).rightCols<3>() * w_WC_C * dt_s);
}

void derotate(FlowField& field, const camera::PinholeCamera& camera, const Eigen::Vector3d& w_WC_C, double dt_s) {
  for (FlowVector& vector : field.vectors) {
    if (vector.valid) vector.flow_px -= rotation_flow_px(camera, vector.center_px, w_WC_C, dt_s);
  }
}

FlowAverage mean_horizontal_flow(const FlowField& field, const camera::PinholeCamera& camera, double dt_s,
                                 Missing missing) {
  FlowAverage mean;
  double sum_px = 0.0;
  for (const FlowVector& vector : field.vectors) {
    if (!vector.valid) continue;
    sum_px += vector.flow_px.x();
    ++mean.count;
  }
  if (mean.count == 0) return mean;
  const double over = missing == Missing::skip ? mean.count : static_cast<double>(field.vectors.size());
  mean.value = sum_px / (over * camera.focal_x_px * dt_s);
  return mean;
}

FlowAverage loom(const FlowField& field, double dt_s, Missing missing) {
  FlowAverage mean;
  double flow_px = 0.0, base_px = 0.0;
  for (int row = 0; row < field.rows; ++row) {
    for (int left = 0; left < field.cols / 2; ++left) {
      const FlowVector &l = field.at(row, left), &r = field.at(row, field.cols - 1 - left);
      const bool both = l.valid && r.valid;
      if (both || missing == Missing::far_away) base_px += r.center_px.x() - l.center_px.x();
      if (!both) continue;
      flow_px += r.flow_px.x() - l.flow_px.x();
      mean.count += 2;
    }
  }
  if (mean.count > 0) mean.value = flow_px / (base_px * dt_s);
  return mean;
}

}  // namespace hedgehop::vision::flow
