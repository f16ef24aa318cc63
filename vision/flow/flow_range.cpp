#include "vision/flow/flow_range.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

namespace hedgehop::vision::flow {
Eigen::Vector2d unit_flow(const Eigen::Vector2d& place, const Eigen::Vector3d& v_WC_C) {
  return place * v_WC_C.z() - v_WC_C.head<2>();
}

Eigen::Vector2d flow_per_s(const FlowVector& vector, const camera::PinholeCamera& camera, double dt_s) {
  return vector.flow_px.cwiseQuotient(dt_s * Eigen::Vector2d(camera.focal_x_px, camera.focal_y_px));
}

double inverse_depth_per_m(const FlowVector& vector, const camera::PinholeCamera& camera, const Eigen::Vector3d& v_WC_C,
                           double dt_s, double floor_mps) {
  if (!vector.valid) return 0.0;
  const Eigen::Vector2d place = camera.ray_at_unit_depth(vector.center_px).head<2>();
  const Eigen::Vector2d b = unit_flow(place, v_WC_C);
  const Eigen::Vector2d flow = flow_per_s(vector, camera, dt_s);
  const double along = b.dot(flow), across = b.x() * flow.y() - b.y() * flow.x();
  return std::max(0.0, along - std::abs(across)) / (b.squaredNorm() + floor_mps * floor_mps);
}

std::vector<double> inverse_ranges_per_m(const FlowField& field, const camera::PinholeCamera& camera,
                                         const Eigen::Vector3d& v_WC_C, double dt_s, double floor_mps) {
  std::vector<double> near;
  near.reserve(field.vectors.size());
  for (const FlowVector& vector : field.vectors) {
    const double stretch = std::hypot(1.0, camera.ray_at_unit_depth(vector.center_px).x());
    const double inverse_range_per_m = inverse_depth_per_m(vector, camera, v_WC_C, dt_s, floor_mps) / stretch;
    near.push_back(vector.valid ? inverse_range_per_m : std::numeric_limits<double>::quiet_NaN());
  }
  return near;
}

std::vector<double> parallax_weights(const FlowField& field, const camera::PinholeCamera& camera,
                                     const Eigen::Vector3d& v_WC_C, double floor_mps) {
  std::vector<double> weights;
  weights.reserve(field.vectors.size());
  for (const FlowVector& vector : field.vectors) {
    const double parallax = unit_flow(camera.ray_at_unit_depth(vector.center_px).head<2>(), v_WC_C).squaredNorm();
    weights.push_back(parallax / (parallax + floor_mps * floor_mps));
  }
  return weights;
}

std::vector<double> bearings_rad(const FlowField& field, const camera::PinholeCamera& camera) {
  std::vector<double> bearings;
  bearings.reserve(field.vectors.size());
  for (const FlowVector& vector : field.vectors) {
    bearings.push_back(std::atan(camera.ray_at_unit_depth(vector.center_px).x()));
  }
  return bearings;
}

double nearest_inverse_range_per_m(std::vector<double> near, double share) {
  if (near.empty()) return 0.0;
  std::replace_if(
      near.begin(), near.end(), [](double value) { return std::isnan(value); }, 0.0);
  const auto count =
      std::clamp(static_cast<size_t>(std::lround(share * static_cast<double>(near.size()))), size_t{1}, near.size());
  const auto end = near.begin() + static_cast<std::ptrdiff_t>(count);
  std::partial_sort(near.begin(), end, near.end(), std::greater<>());
  return std::accumulate(near.begin(), end, 0.0) / static_cast<double>(count);
}

}  // namespace hedgehop::vision::flow
