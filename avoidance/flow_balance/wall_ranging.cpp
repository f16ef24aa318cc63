#include "avoidance/flow_balance/wall_ranging.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "vision/flow/flow_range.h"

namespace hedgehop::avoidance::flow_balance {
namespace {

/// Standard deviation of a flow vector per axis, px. Chosen: some hundredths on a plane, more across a wall's edge.
constexpr double kFlowNoisePx = 0.1;
/// Of a wall's distance, at most. Chosen: a worse fit may be off by a third, and patches stand in.
constexpr double kRelativeError = 0.3;
/// A wall is never nearer than this, m, so that its inverse range stays finite.
constexpr double kLeastRangeM = 1e-3;
/// Of the angle between a wall's direction and the axis of the camera that looks at it: 45 deg, for four cameras.
constexpr double kSideCosine = 0.5 * std::numbers::sqrt2;

vision::flow::WallFlowSample observe(const vision::flow::FlowVector& vector, const CameraFlow& camera,
                                     const Eigen::Vector3d& v_WC_C, double dt_s) {
  const vision::camera::PinholeCamera& lens = camera.pinhole();
  const Eigen::Isometry3d& X_BC = camera.camera().X_BC;
  const Eigen::Vector2d place = lens.ray_at_unit_depth(vector.center_px).head<2>();
  vision::flow::WallFlowSample observation;
  observation.ray_H = X_BC.linear().col(2).head<2>() + place.x() * X_BC.linear().col(0).head<2>();
  observation.p_BC_H = X_BC.translation().head<2>();
  observation.unit_flow = vision::flow::unit_flow(place, v_WC_C);
  observation.flow = vision::flow::flow_per_s(vector, lens, dt_s);
  observation.noise = kFlowNoisePx / (lens.focal_x_px * dt_s);
  return observation;
}

}  // namespace

std::vector<vision::flow::WallEstimate> fit_walls(std::span<const CameraFlow> cameras,
                                                  const NavigationState& navigation, int64_t now_ns) {
  using std::numbers::pi;
  std::vector<std::pair<double, vision::flow::WallFlowSample>> by_bearing;
  for (const CameraFlow& camera : cameras) {
    const auto measure = camera.measure(now_ns);
    if (!measure) continue;
    const Eigen::Vector3d v_WC_C = velocity_in_camera(camera.camera().X_BC, navigation);
    for (const vision::flow::FlowVector& vector : camera.field().vectors) {
      if (!vector.valid) continue;
      const vision::flow::WallFlowSample observation = observe(vector, camera, v_WC_C, measure->dt_s);
      // Counted from between a rear and a left camera, so that no image is cut in two.
      const double bearing_rad =
          std::fmod(std::atan2(observation.ray_H.y(), observation.ray_H.x()) + 2.75 * pi, 2.0 * pi);
      by_bearing.emplace_back(bearing_rad, observation);
    }
  }
  std::ranges::stable_sort(by_bearing, {}, [](const auto& item) { return item.first; });
  std::vector<vision::flow::WallFlowSample> observations;
  for (const auto& [bearing_rad, observation] : by_bearing) observations.push_back(observation);
  return vision::flow::walls_from_flow(observations, kRelativeError);
}

void WallRanging::update(const SideCameras& cameras, const NavigationState& navigation) {
  patches_.update(cameras, navigation);
  axes_H_ = cameras.axes_H();
  walls_ = fit_walls(cameras.cameras(), navigation, cameras.now_ns());
}

PerSide WallRanging::left_once_stopped_per_m(const Approach& approach) const {
  if (walls_.empty()) return patches_.left_once_stopped_per_m(approach);
  PerSide result{};
  for (size_t i = 0; i < kSideCount; ++i) result[i] = left_on_side_per_m(axes_H_[i], approach);
  return result;
}

double WallRanging::left_on_side_per_m(const Eigen::Vector2d& axis_H, const Approach& approach) const {
  double nearest_per_m = 0.0;
  for (const vision::flow::WallEstimate& wall : walls_) {
    const Eigen::Vector2d to_wall_H = wall.inverse_range_per_m.normalized();
    if (to_wall_H.dot(axis_H) < kSideCosine) continue;  // on another side
    if (approach.v_cmd_H.dot(to_wall_H) <= 0.0) continue;
    const double closing_mps = std::max(approach.v_H.dot(to_wall_H), approach.v_cmd_H.dot(to_wall_H));
    const double tail_m = approach.tail_m * std::max(0.0, -to_wall_H.x());
    const double range_m = std::max(1.0 / wall.inverse_range_per_m.norm() - tail_m, kLeastRangeM);
    const double reversing_mps =
        approach.reverses_both ? std::max(approach.v_H.norm(), approach.v_cmd_H.norm()) : closing_mps;
    const double stops_m = stopping_distance_m(closing_mps, reversing_mps, approach.stopping);
    nearest_per_m = std::max(nearest_per_m, inverse_range_left_per_m(1.0 / range_m, stops_m));
  }
  return nearest_per_m;
}

}  // namespace hedgehop::avoidance::flow_balance
