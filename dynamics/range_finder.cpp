#include "dynamics/range_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace hedgehop::dynamics {

RangeFinder::RangeFinder(const RangeFinderConfig& config, double physics_dt_s, uint64_t seed)
    : config_(config),
      direction_B_(config.direction_B.stableNormalized()),
      period_(period_ticks("range_finder.rate", config.rate_hz, physics_dt_s)),
      noise_(seed) {
  if (!config.direction_B.allFinite() || config.direction_B.isZero(0.0)) {
    throw std::invalid_argument("range_finder.direction: must be finite and not zero");
  }
  require_not_negative("range_finder.min", config.min_m);
  require_not_negative("range_finder.noise", config.noise_m);
  require_not_negative("range_finder.noise_per_range", config.noise_per_range);
  require_range("range_finder.dropout", config.dropout, 0.0, 1.0);
  require_not_negative("range_finder.latency", config.latency_s);
  if (!(config.max_m > config.min_m)) throw std::invalid_argument("range_finder.max: must be greater than 'min'");
  past_m_.assign(static_cast<size_t>(std::llround(config.latency_s / physics_dt_s)) + 1,
                 std::numeric_limits<double>::infinity());
}

void RangeFinder::feel(double distance_m) {
  past_m_[next_] = distance_m;
  next_ = (next_ + 1) % past_m_.size();
}

std::optional<double> RangeFinder::read() {
  // The same number of draws whatever happens, so that a drop-out shifts nothing.
  const bool lost = noise_.chance(config_.dropout);
  const double normal = noise_.draw();
  const double range_m = past_m_[next_];  // the oldest
  const bool in_range = range_m >= config_.min_m && range_m <= config_.max_m;
  if (lost || !in_range || !config_.enabled) return std::nullopt;
  return std::max(0.0, range_m + std::hypot(config_.noise_m, config_.noise_per_range * range_m) * normal);
}

}  // namespace hedgehop::dynamics
