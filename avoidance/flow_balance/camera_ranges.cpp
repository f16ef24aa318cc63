#include "avoidance/flow_balance/camera_ranges.h"

#include <cmath>

#include "vision/flow/flow_range.h"

namespace hedgehop::avoidance::flow_balance {

Eigen::Vector3d velocity_in_camera(const Eigen::Isometry3d& X_BC, const NavigationState& navigation) {
  const Eigen::Vector3d v_WC_B = navigation.v_WB_B_est + navigation.w_WB_B_est.cross(X_BC.translation());
  return X_BC.linear().transpose() * v_WC_B;
}

void CameraRanges::update(const CameraFlow& camera, const NavigationState& navigation, double dt_s) {
  const vision::camera::PinholeCamera& model = camera.pinhole();
  const Eigen::Vector3d v_WC_C = velocity_in_camera(camera.camera().X_BC, navigation);

  const std::vector<double> near =
      vision::flow::inverse_ranges_per_m(camera.field(), model, v_WC_C, dt_s, options_.floor_mps);
  const std::vector<double> weights = vision::flow::parallax_weights(camera.field(), model, v_WC_C, options_.floor_mps);
  const std::vector<double> bearings_rad = vision::flow::bearings_rad(camera.field(), model);
  std::vector<RangeMemory::Sight> sights;
  sights.reserve(near.size());
  for (size_t i = 0; i < near.size(); ++i) {
    const double closing_mps = v_WC_C.z() * std::cos(bearings_rad[i]) + v_WC_C.x() * std::sin(bearings_rad[i]);
    sights.push_back({near[i], weights[i], closing_mps});
  }
  lasting_.add(memory_.update(sights, dt_s));
}

}  // namespace hedgehop::avoidance::flow_balance
