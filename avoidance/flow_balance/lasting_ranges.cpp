#include "avoidance/flow_balance/lasting_ranges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hedgehop::avoidance::flow_balance {

void LastingRanges::add(std::vector<double> inverse_ranges_per_m) {
  latest_[next_] = std::move(inverse_ranges_per_m);
  next_ = (next_ + 1) % latest_.size();
}

std::vector<double> LastingRanges::lasting_per_m() const {
  std::vector<double> least(latest_.front().size(), std::numeric_limits<double>::infinity());
  std::vector<size_t> known(least.size(), 0);
  for (const std::vector<double>& image : latest_) {
    for (size_t i = 0; i < image.size(); ++i) {
      if (std::isnan(image[i])) continue;
      least[i] = std::min(least[i], image[i]);
      ++known[i];
    }
  }
  for (size_t i = 0; i < least.size(); ++i) {
    if (2 * known[i] <= latest_.size()) least[i] = 0.0;
  }
  return least;
}

}  // namespace hedgehop::avoidance::flow_balance
