#include "dynamics/height_sensor.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hedgehop::dynamics {

HeightSensor::HeightSensor(const HeightSensorConfig& config, double physics_dt_s, uint64_t seed)
    : config_(config), period_(period_ticks("height_sensor.rate", config.rate_hz, physics_dt_s)), noise_(seed) {
  require_not_negative("height_sensor.min", config.min_m);
  require_not_negative("height_sensor.noise", config.noise_m);
  require_not_negative("height_sensor.noise_per_range", config.noise_per_range);
  require_range("height_sensor.dropout", config.dropout, 0.0, 1.0);
  if (!(config.max_m > config.min_m)) throw std::invalid_argument("height_sensor.max: must be greater than 'min'");
}

std::optional<double> HeightSensor::read(double height_above_surface_m) {
  // The same number of draws whatever happens, so that a drop-out shifts nothing.
  const bool lost = noise_.chance(config_.dropout);
  const double normal = noise_.draw();
  const bool in_range = height_above_surface_m >= config_.min_m && height_above_surface_m <= config_.max_m;
  if (lost || !in_range || !config_.enabled) return std::nullopt;
  return std::max(0.0, height_above_surface_m + height_sigma_m(config_, height_above_surface_m) * normal);
}

double height_sigma_m(const HeightSensorConfig& config, double range_m) {
  return std::hypot(config.noise_m, config.noise_per_range * range_m);
}

}  // namespace hedgehop::dynamics
