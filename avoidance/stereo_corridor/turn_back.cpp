#include "avoidance/stereo_corridor/turn_back.h"

#include <algorithm>
#include <cmath>

namespace hedgehop::avoidance::stereo_corridor {

bool TurnBack::update(const Eigen::Vector3d& p_CG_C) {
  constexpr double kAhead = 0.2;    // tangent of the bearing: most of the image lies round the goal
  constexpr double kNearerM = 3.0;  // progress that makes the last turn a success
  constexpr double kWanderM = 0.3;  // drift of a position estimate while a goal is passed
  const double distance_m = std::hypot(p_CG_C.x(), p_CG_C.z());
  nearest_m_ = std::min(nearest_m_, distance_m);
  if (distance_m < nearest_ever_m_ - kNearerM) {
    nearest_ever_m_ = distance_m;
    may_pass_m_ = kMayPassM;
  }
  const bool recedes = distance_m > nearest_m_ + kWanderM;
  if (!turning_ && recedes && -p_CG_C.z() > may_pass_m_) {
    turning_ = true;
    may_pass_m_ *= 2.0;
  } else if (turning_ && std::abs(p_CG_C.x()) < kAhead * p_CG_C.z()) {
    turning_ = false;
    nearest_m_ = distance_m;
  }
  return turning_;
}

}  // namespace hedgehop::avoidance::stereo_corridor
