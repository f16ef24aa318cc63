#include "avoidance/landmark_map/wall_stop.h"

#include <algorithm>
#include <cmath>

namespace hedgehop::avoidance::landmark_map {

bool WallStop::update(const std::optional<CameraFlow::Measure>& flow, const NavigationState& navigation) {
  constexpr int kAlarms = 6;  // consecutive alarms: a single measurement may be an outlier
  smooth(flow);
  const double v_mps = std::max(0.0, navigation.v_WB_B_est.x());
  const double reaction_m = v_mps * kReactionS + 0.5 * v_mps * v_mps / kBrakingMps2;
  const bool near =
      loom_per_s_ * time_to_contact_s_ > 1.0 || (navigation.range_m && *navigation.range_m < kStopRangeM + reaction_m);
  alarms_ = near ? alarms_ + 1 : 0;
  stopped_ = stopped_ || alarms_ >= kAlarms;
  return stopped_;
}

void WallStop::smooth(const std::optional<CameraFlow::Measure>& flow) {
  constexpr double kFlowShare =
      0.5;  // minimum share of valid patches: with fewer, the divergence describes only part of the view
  constexpr double kSmoothS = 0.8;  // the error of a single pair of images exceeds the alarm threshold
  if (!flow || flow->valid_share < kFlowShare) {
    loom_per_s_ = 0.0;
    return;
  }
  const double share = 1.0 - std::exp(-flow->dt_s / kSmoothS);
  loom_per_s_ += share * (flow->loom_per_s - loom_per_s_);
}

}  // namespace hedgehop::avoidance::landmark_map
