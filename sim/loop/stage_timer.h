#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "sim/flight/flight.h"

namespace hedgehop::sim {

/// Wall time of one stage of the loop, for reports only.
class StageTimer {
 public:
  using Clock = std::chrono::steady_clock;

  /// Measures from its construction to its destruction.
  class Lap {
   public:
    explicit Lap(StageTimer& timer) : timer_(timer), start_(Clock::now()) {}
    ~Lap() { timer_.laps_ms_.push_back(std::chrono::duration<float, std::milli>(Clock::now() - start_).count()); }
    Lap(const Lap&) = delete;
    Lap& operator=(const Lap&) = delete;

   private:
    StageTimer& timer_;
    Clock::time_point start_;
  };

  [[nodiscard]] Lap lap() { return Lap(*this); }
  /// Median and 95th percentile of the laps (nearest rank); zeros without laps.
  StageTime summary() const;

 private:
  std::vector<float> laps_ms_;
};

inline StageTime StageTimer::summary() const {
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
