#include "avoidance/policy/action_pilot.h"

#include <algorithm>
#include <cmath>

#include "avoidance/heading.h"

namespace hedgehop::avoidance::policy {

State state_of(const NavigationState& navigation, const Goal& goal) {
  const Eigen::Vector3d p_BG_W = goal.p_WG - navigation.p_WB_est;
  const Eigen::Vector2d p_BG_H = rotated(p_BG_W.head<2>(), -heading_rad(navigation.q_WB_est));
  const Eigen::Quaterniond& q = navigation.q_WB_est;
  const double roll_rad =
      std::atan2(2.0 * (q.w() * q.x() + q.y() * q.z()), 1.0 - 2.0 * (q.x() * q.x() + q.y() * q.y()));
  const double pitch_rad = std::asin(std::clamp(2.0 * (q.w() * q.y() - q.z() * q.x()), -1.0, 1.0));
  Eigen::Matrix<double, State::RowsAtCompileTime, 1> state;
  state << p_BG_H, p_BG_W.z(), navigation.v_WB_B_est, roll_rad, pitch_rad, navigation.w_WB_B_est.z(),
      navigation.height_above_ground_m;
  return state.cast<float>();
}

ActionPilot::ActionPilot(const NavigationState& navigation)
    : altitude_m_(-navigation.p_WB_est.z()), heading_rad_(heading_rad(navigation.q_WB_est)) {}

VelocityCommand ActionPilot::fly(const Action& action, const NavigationState& navigation, double speed_limit_mps,
                                 double step_s) {
  const Action share = action.cwiseMax(-1.0).cwiseMin(1.0);
  const double heading = heading_rad(navigation.q_WB_est), altitude_m = -navigation.p_WB_est.z();
  const double higher_m = altitude_m_ + kClimbMps * share[2] * step_s - altitude_m;
  const double further_rad = wrap_angle(heading_rad_ + kTurnRadps * share[3] * step_s - heading);
  altitude_m_ = altitude_m + std::clamp(higher_m, -kAheadM, kAheadM);
  heading_rad_ = heading + std::clamp(further_rad, -kAheadRad, kAheadRad);
  return {rotated(speed_limit_mps * share.head<2>(), heading), altitude_m_, heading_rad_};
}

}  // namespace hedgehop::avoidance::policy
