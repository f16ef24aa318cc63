#include "sim/loop/stage_timer.h"

#include <algorithm>
#include <cmath>

namespace hedgehop::sim {

StageTime StageTimer::summary() const {
  if (laps_ms_.empty()) return {};
  std::vector<float> laps = laps_ms_;
  const auto nearest_rank = [&laps](double share) {
    const auto rank = static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(laps.size()))) - 1;
    std::nth_element(laps.begin(), laps.begin() + rank, laps.end());
    return static_cast<double>(laps[static_cast<size_t>(rank)]);
  };
  return {nearest_rank(0.5), nearest_rank(0.95)};
}

}  // namespace hedgehop::sim
