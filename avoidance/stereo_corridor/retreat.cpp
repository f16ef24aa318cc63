#include "avoidance/stereo_corridor/retreat.h"

namespace hedgehop::avoidance::stereo_corridor {

std::optional<Eigen::Vector3d> Retreat::update(const Eigen::Vector3d& p_WB, double nearest_m) {
  constexpr double kThereM = 0.3;  // accuracy of a hover
  if (nearest_m >= clearance_m_) clear_W_ = p_WB;
  if (nearest_m >= clearance_m_ || !clear_W_ || (*clear_W_ - p_WB).norm() < kThereM) return std::nullopt;
  return clear_W_;
}

}  // namespace hedgehop::avoidance::stereo_corridor
