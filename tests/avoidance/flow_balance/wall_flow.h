#pragma once

#include <cmath>

#include "avoidance/flow_balance/balance_law.h"
#include "tests/avoidance/flow_balance/flow_rig.h"
#include "tests/vision/flow/projected_flow.h"
#include "vision/flow/flow_measures.h"

namespace hedgehop::avoidance::flow_balance {

/// Measurement of a camera that looks at a wall, computed from projected points instead of a formula for flow.
/// @param v_B  velocity of the vehicle, level, m/s.  @param range_m  shortest distance to the wall, > 0.
/// @param azimuth_rad  of the nearest point of the wall, from the camera's axis to the right; 0 faces the wall.
inline SideFlow flow_of_wall(const MountedCamera& camera, const Eigen::Vector2d& v_B, double range_m,
                             double azimuth_rad = 0.0) {
  constexpr double kStepS = 1e-4;
  const Eigen::Matrix3d R_CB = camera.X_BC.linear().transpose();
  const Eigen::Vector3d normal_C(std::sin(azimuth_rad), 0, std::cos(azimuth_rad));
  const auto field = vision::plane_flow(camera.model.pinhole(), vision::grid_field(8, 8, 30, 200), range_m * normal_C,
                                        normal_C, R_CB * Eigen::Vector3d(v_B.x(), v_B.y(), 0), {0, 0, 0}, kStepS);
  return {camera.X_BC.linear().col(2).head<2>(), camera.X_BC.linear().col(0).head<2>(),
          vision::flow::mean_horizontal_flow(field, camera.model.pinhole(), kStepS, vision::flow::Missing::skip).value,
          vision::flow::loom(field, kStepS, vision::flow::Missing::skip).value};
}

}  // namespace hedgehop::avoidance::flow_balance
