#include "avoidance/flow_balance/camera_walls.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "avoidance/flow_balance/camera_ranges.h"
#include "vision/flow/flow_range.h"

namespace hedgehop::avoidance::flow_balance {

std::vector<vision::flow::WallEstimate> walls_round(std::span<const CameraFlow> cameras,
                                                    const NavigationState& navigation, int64_t now_ns,
                                                    const WallOptions& options) {
  using std::numbers::pi;
  std::vector<std::pair<double, vision::flow::WallObservation>> by_bearing;
  for (const CameraFlow& camera : cameras) {
    const auto measure = camera.measure(now_ns);
    if (!measure) continue;
    const vision::camera::PinholeCamera& lens = camera.pinhole();
    const Eigen::Isometry3d& X_BC = camera.camera().X_BC;
    const Eigen::Vector3d v_WC_C = velocity_in_camera(X_BC, navigation);
    for (const vision::flow::FlowVector& vector : camera.field().vectors) {
      if (!vector.valid) continue;
      const Eigen::Vector2d place = lens.ray(vector.center_px).head<2>();
      vision::flow::WallObservation sight;
      sight.ray_H = X_BC.linear().col(2).head<2>() + place.x() * X_BC.linear().col(0).head<2>();
      sight.p_BC_H = X_BC.translation().head<2>();
      sight.unit_flow = vision::flow::unit_flow(place, v_WC_C);
      sight.flow = vision::flow::flow_per_s(vector, lens, measure->dt_s);
      sight.noise = options.flow_noise_px / (lens.focal_x_px * measure->dt_s);
      // Counted from between a rear and a left camera, so that no image is cut in two.
      const double bearing_rad = std::fmod(std::atan2(sight.ray_H.y(), sight.ray_H.x()) + 2.75 * pi, 2.0 * pi);
      by_bearing.emplace_back(bearing_rad, sight);
    }
  }
  std::ranges::stable_sort(by_bearing, {}, [](const auto& item) { return item.first; });
  std::vector<vision::flow::WallObservation> sights;
  for (const auto& [bearing_rad, sight] : by_bearing) sights.push_back(sight);
  return vision::flow::walls_from_flow(sights, options.relative_error);
}

}  // namespace hedgehop::avoidance::flow_balance
