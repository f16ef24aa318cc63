#include "avoidance/flow_balance/mean_ranging.h"

#include <algorithm>

#include "avoidance/flow_balance/balance_law.h"
#include "avoidance/heading.h"

namespace hedgehop::avoidance::flow_balance {

void MeanRanging::update(const SideCameras& cameras, const NavigationState& navigation) {
  const Eigen::Vector2d v_H = velocity_H(navigation);
  for (size_t i = 0; i < kSideCount; ++i) {
    const InverseRanges inverse = inverse_ranges(cameras.flows()[i], v_H);
    nearest_per_m_[i] = std::max(inverse.from_flow_per_m, inverse.from_loom_per_m);
  }
}

}  // namespace hedgehop::avoidance::flow_balance
