#include "dynamics/sensors/barometer.h"

#include <cmath>

#include "dynamics/air/atmosphere.h"
#include "sim/fields/bounds.h"

namespace hedgehop::dynamics::sensors {

Barometer::Barometer(const BarometerConfig& config, double physics_dt_s, uint64_t seed)
    : config_(fields::require_bounds(config, "barometer")),
      period_(period_ticks("barometer.rate", config.rate_hz, physics_dt_s)),
      sample_dt_s_(static_cast<double>(period_) * physics_dt_s),
      noise_(seed),
      memory_(config.lag_s > 0.0 ? std::exp(-physics_dt_s / config.lag_s) : 0.0) {
  wander_pa_ = config.wander_pa * noise_.normal();
}

void Barometer::observe(double altitude_m) {
  altitude_m_ = altitude_m + memory_ * (altitude_m_.value_or(altitude_m) - altitude_m);
}

std::optional<double> Barometer::read() {
  const GaussMarkov process = barometer_wander(config_);
  wander_pa_ = process.decay(sample_dt_s_) * wander_pa_ + process.added_sigma(sample_dt_s_) * noise_.normal();
  const double noise_pa = config_.noise_pa * noise_.normal();
  const bool lost = config_.dropout > 0.0 && noise_.chance(config_.dropout);
  if (lost || !altitude_m_) return std::nullopt;
  return air::standard_air(*altitude_m_).pressure_pa + wander_pa_ + noise_pa;
}

GaussMarkov barometer_wander(const BarometerConfig& config) { return {config.wander_pa, config.wander_time_s}; }

}  // namespace hedgehop::dynamics::sensors
