#include "avoidance/flow_balance/range_memory.h"

#include <cmath>
#include <limits>

namespace hedgehop::avoidance::flow_balance {

const std::vector<double>& RangeMemory::update(std::span<const Measurement> measurements, double dt_s) {
  constexpr double kLeastShare = 0.5;  // of the range: no wall comes twice as near from one image to the next
  inverse_ranges_per_m_.resize(measurements.size(), std::numeric_limits<double>::quiet_NaN());
  const double retained = time_constant_s_ > 0.0 ? std::exp(-dt_s / time_constant_s_) : 0.0;
  for (size_t i = 0; i < measurements.size(); ++i) {
    const Measurement& measured = measurements[i];
    double& inverse_per_m = inverse_ranges_per_m_[i];
    const double share_left = 1.0 - inverse_per_m * measured.closing_mps * dt_s;  // of the range, after this step
    const double expected = retained * inverse_per_m / (share_left > kLeastShare ? share_left : kLeastShare);
    if (std::isnan(measured.inverse_range_per_m)) {
      inverse_per_m = retained > 0.0 ? expected : measured.inverse_range_per_m;
    } else {
      inverse_per_m = std::isnan(expected) ? measured.inverse_range_per_m
                                           : measured.inverse_range_per_m + (1.0 - measured.weight) * expected;
    }
  }
  return inverse_ranges_per_m_;
}

}  // namespace hedgehop::avoidance::flow_balance
