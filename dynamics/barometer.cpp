#include "dynamics/barometer.h"

#include "dynamics/atmosphere.h"

namespace hedgehop::dynamics {

Barometer::Barometer(const BarometerConfig& config, double physics_dt_s, uint64_t seed)
    : config_(config),
      period_(period_ticks("barometer.rate", config.rate_hz, physics_dt_s)),
      sample_dt_s_(static_cast<double>(period_) * physics_dt_s),
      noise_(seed) {
  require_not_negative("barometer.noise", config.noise_pa);
  require_not_negative("barometer.wander", config.wander_pa);
  require_positive("barometer.wander_time", config.wander_time_s);
  wander_pa_ = config.wander_pa * noise_.draw();
}

double Barometer::read(double altitude_m) {
  const GaussMarkov process = barometer_wander(config_);
  wander_pa_ = process.decay(sample_dt_s_) * wander_pa_ + process.added_sigma(sample_dt_s_) * noise_.draw();
  return standard_air(altitude_m).pressure_pa + wander_pa_ + config_.noise_pa * noise_.draw();
}

GaussMarkov barometer_wander(const BarometerConfig& config) { return {config.wander_pa, config.wander_time_s}; }

}  // namespace hedgehop::dynamics
