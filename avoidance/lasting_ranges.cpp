#include "avoidance/lasting_ranges.h"

#include <algorithm>
#include <utility>

namespace hedgehop::avoidance {

void LastingRanges::add(std::vector<double> inverse_ranges_per_m) {
  latest_[next_] = std::move(inverse_ranges_per_m);
  next_ = (next_ + 1) % latest_.size();
}

std::vector<double> LastingRanges::lasting_per_m() const {
  std::vector<double> least = latest_.front();
  for (const std::vector<double>& picture : latest_) {
    if (picture.empty()) return std::vector<double>(least.size(), 0.0);
    for (size_t i = 0; i < least.size(); ++i) least[i] = std::min(least[i], picture[i]);
  }
  return least;
}

}  // namespace hedgehop::avoidance
