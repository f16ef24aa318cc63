#include "sim/flightlog/state_errors.h"

#include <Eigen/Geometry>

namespace hedgehop::sim {

StateError state_error(const dynamics::RigidBodyState& predicted, const dynamics::RigidBodyState& measured) {
  const Eigen::Vector3d v_W_error = predicted.q_WB * predicted.v_WB_B - measured.q_WB * measured.v_WB_B;
  Eigen::Vector3d angles =
      dynamics::to_roll_pitch_heading(predicted.q_WB) - dynamics::to_roll_pitch_heading(measured.q_WB);
  for (double& angle : angles) angle = dynamics::wrap_angle(angle);
  StateError error;
  error << predicted.p_WB - measured.p_WB, measured.q_WB.conjugate() * v_W_error, angles,
      predicted.w_WB_B - measured.w_WB_B;
  return error;
}

dynamics::RigidBodyState at_constant_velocity(const dynamics::RigidBodyState& state, double time_s) {
  dynamics::RigidBodyState moved = state;
  const Eigen::Vector3d v_W = state.q_WB * state.v_WB_B;
  const double angle_rad = state.w_WB_B.norm() * time_s;
  if (angle_rad > 0.0) {
    moved.q_WB = (state.q_WB * Eigen::AngleAxisd(angle_rad, state.w_WB_B.normalized())).normalized();
  }
  moved.p_WB += v_W * time_s;
  moved.v_WB_B = moved.q_WB.conjugate() * v_W;
  return moved;
}

Eigen::Vector4d group_norms(const StateError& rmse) {
  Eigen::Vector4d norms;
  for (Eigen::Index g = 0; g < norms.size(); ++g) norms[g] = rmse.segment<kPerGroup>(kPerGroup * g).norm();
  return norms;
}

}  // namespace hedgehop::sim
