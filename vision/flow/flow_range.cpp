#include "vision/flow/flow_range.h"

#include <Eigen/LU>
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

namespace {

/// Least-squares sums for m over the first patches, in units of their noise.
struct Sums {
  Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();  ///< on m from the vehicle's motion
  Eigen::Vector2d c = Eigen::Vector2d::Zero();
  double squares = 0.0;

  void add(const WallFlowSample& sample) {
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector2d slope =
          (sample.unit_flow[k] * sample.ray_H + sample.flow[k] * sample.p_BC_H) / sample.noise;
      const double flow = sample.flow[k] / sample.noise;
      A += slope * slope.transpose();
      const Eigen::Vector2d shift = sample.unit_flow[k] * sample.ray_H / sample.noise;
      information += shift * shift.transpose();
      c += flow * slope;
      squares += flow * flow;
    }
  }
  Sums minus(const Sums& other) const {
    return {A - other.A, information - other.information, c - other.c, squares - other.squares};
  }
};

struct Fit {
  WallEstimate wall;
  double squares = std::numeric_limits<double>::infinity();  ///< of the residual flow
};

Fit fit(const Sums& sums, size_t patches) {
  const Eigen::FullPivLU<Eigen::Matrix2d> lu(sums.A), information(sums.information);
  if (!lu.isInvertible() || !information.isInvertible()) return {};
  const Eigen::Vector2d near = lu.solve(sums.c);
  const double inverse_range_per_m = near.norm();
  if (!(inverse_range_per_m > 0.0)) return {};
  const double squares = std::max(0.0, sums.squares - sums.c.dot(near));
  const double scatter = std::max(1.0, squares / (2.0 * static_cast<double>(patches) - 2.0));
  const Eigen::Vector2d n = near / inverse_range_per_m;
  return {{near, std::sqrt(scatter * n.dot(information.solve(n))) / inverse_range_per_m}, squares};
}

}  // namespace

std::vector<WallEstimate> walls_from_flow(std::span<const WallFlowSample> samples, double relative_error) {
  constexpr size_t kMinPatches = 3;       // minimum number of patches of a wall
  constexpr double kWallPenalty = 12.0;   // penalty per wall: six times its two parameters
  constexpr double kNoWallCost = 1000.0;  // cost of a patch without a wall, far above that of a fitting patch
  std::vector<Sums> upto(1);
  for (const WallFlowSample& sample : samples) {
    upto.push_back(upto.back());
    upto.back().add(sample);
  }
  std::vector<double> min_cost(upto.size(), std::numeric_limits<double>::infinity());
  std::vector<size_t> begin(upto.size(), 0);
  min_cost[0] = 0.0;
  for (size_t end = 1; end < upto.size(); ++end) {
    min_cost[end] = min_cost[end - 1] + kNoWallCost;
    begin[end] = end - 1;
    for (size_t first = 0; first + kMinPatches <= end; ++first) {
      const double squares = min_cost[first] + fit(upto[end].minus(upto[first]), end - first).squares + kWallPenalty;
      if (squares >= min_cost[end]) continue;
      min_cost[end] = squares;
      begin[end] = first;
    }
  }
  std::vector<WallEstimate> walls;
  for (size_t end = upto.size() - 1; end > 0; end = begin[end]) {
    if (end - begin[end] < kMinPatches) continue;
    const Fit found = fit(upto[end].minus(upto[begin[end]]), end - begin[end]);
    if (found.wall.relative_error <= relative_error) walls.insert(walls.begin(), found.wall);
  }
  return walls;
}

}  // namespace hedgehop::vision::flow
