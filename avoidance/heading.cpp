#include "avoidance/heading.h"

#include <cmath>

namespace hedgehop::avoidance {

double heading_rad(const Eigen::Quaterniond& q_WB) {
  const Eigen::Vector3d forward_W = q_WB * Eigen::Vector3d::UnitX();
  return std::atan2(forward_W.y(), forward_W.x());
}

}  // namespace hedgehop::avoidance
