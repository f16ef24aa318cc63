#include "avoidance/flow_balance/range_memory.h"

#include <cmath>
#include <limits>

namespace hedgehop::avoidance::flow_balance {

const std::vector<double>& RangeMemory::update(std::span<const Sight> sights, double dt_s) {
  near_per_m_.resize(sights.size(), std::numeric_limits<double>::quiet_NaN());
  const double kept = time_constant_s_ > 0.0 ? std::exp(-dt_s / time_constant_s_) : 0.0;
  for (size_t i = 0; i < sights.size(); ++i) {
    const Sight& sight = sights[i];
    double& near = near_per_m_[i];
    const double share_left = 1.0 - near * sight.closing_mps * dt_s;  // of the range, after this step
    constexpr double kLeast = 0.5;  // no wall comes twice as near from one image to the next
    const double expected = kept * near / (share_left > kLeast ? share_left : kLeast);
    if (std::isnan(sight.near_per_m)) {
      near = kept > 0.0 ? expected : sight.near_per_m;
    } else {
      near = std::isnan(expected) ? sight.near_per_m : sight.near_per_m + (1.0 - sight.weight) * expected;
    }
  }
  return near_per_m_;
}

}  // namespace hedgehop::avoidance::flow_balance
