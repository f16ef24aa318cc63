#include "dynamics/sensors/ranger.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "sim/fields/bounds.h"
#include "sim/fields/invalid_field.h"

namespace hedgehop::dynamics::sensors {

Ranger::Ranger(const std::string& key, const RangerConfig& config, double physics_dt_s, uint64_t seed)
    : config_(fields::require_bounds(config, key)),
      period_(period_ticks(key + ".rate", config.rate_hz, physics_dt_s)),
      noise_(seed) {
  if (!(config.max_m > config.min_m)) throw fields::InvalidField(key + ".max", "must be greater than 'min'");
  latency_ = std::llround(config.latency_s / physics_dt_s);
  observed_m_.assign(static_cast<size_t>(latency_ / period_) + 1, std::numeric_limits<double>::infinity());
  if (config.offset_m > 0.0) offset_m_ = config.offset_m * noise_.normal();
}

void Ranger::observe(double distance_m) {
  observed_m_[next_] = distance_m;
  next_ = (next_ + 1) % observed_m_.size();
}

std::optional<double> Ranger::read() {
  // The same number of draws whatever happens, so that a drop-out shifts nothing.
  const bool lost = noise_.chance(config_.dropout);
  const double normal = noise_.normal();
  const double range_m = observed_m_[next_];  // the oldest
  const bool in_range = range_m >= config_.min_m && range_m <= config_.max_m;
  if (lost || !in_range || !config_.enabled) return std::nullopt;
  return std::max(0.0, range_m + offset_m_ + noise_sigma_m(config_, range_m) * normal);
}

double noise_sigma_m(const RangerConfig& config, double range_m) {
  return std::hypot(config.noise_m, config.noise_per_range * range_m);
}

}  // namespace hedgehop::dynamics::sensors
