#include "dynamics/sensors/magnetometer.h"

#include "dynamics/rigid_body.h"
#include "sim/fields/bounds.h"

namespace hedgehop::dynamics::sensors {

Magnetometer::Magnetometer(const MagnetometerConfig& config, double physics_dt_s, uint64_t seed)
    : config_(fields::require_bounds(config, "magnetometer")),
      period_(period_ticks("magnetometer.rate", config.rate_hz, physics_dt_s)),
      noise_(seed) {
  offset_rad_ = config.offset_rad * noise_.normal();
}

std::optional<double> Magnetometer::read(double heading_rad) {
  const double noise_rad = config_.noise_rad * noise_.normal();
  const bool lost = config_.dropout > 0.0 && noise_.chance(config_.dropout);
  if (lost || !config_.enabled) return std::nullopt;
  return wrap_angle(heading_rad + offset_rad_ + noise_rad);
}

}  // namespace hedgehop::dynamics::sensors
