#include "avoidance/heading.h"

#include <cmath>

namespace hedgehop::avoidance {

double heading_rad(const Eigen::Quaterniond& q_WB) {
  const Eigen::Vector3d forward_W = q_WB * Eigen::Vector3d::UnitX();
  return std::atan2(forward_W.y(), forward_W.x());
}

Eigen::Vector2d rotated(const Eigen::Vector2d& vector, double angle_rad) {
  return Eigen::Rotation2Dd(angle_rad) * vector;
}

Eigen::Vector2d velocity_H(const NavigationState& navigation) {
  const Eigen::Vector2d v_WB_W = (navigation.q_WB_est * navigation.v_WB_B_est).head<2>();
  return rotated(v_WB_W, -heading_rad(navigation.q_WB_est));
}

}  // namespace hedgehop::avoidance
