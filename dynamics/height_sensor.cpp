#include "dynamics/height_sensor.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace hedgehop::dynamics {
namespace {

constexpr double kRingSpacingM = 0.5;  // chosen: obstacles on roofs and the ground are rarely narrower
constexpr double kWidestConeRad = 0.7853981633974483;

}  // namespace

HeightSensor::HeightSensor(const HeightSensorConfig& config, double physics_dt_s, uint64_t seed)
    : config_(config), period_(period_ticks("height_sensor.rate", config.rate_hz, physics_dt_s)), noise_(seed) {
  require_not_negative("height_sensor.min", config.min_m);
  require_not_negative("height_sensor.noise", config.noise_m);
  require_not_negative("height_sensor.noise_per_range", config.noise_per_range);
  require_range("height_sensor.dropout", config.dropout, 0.0, 1.0);
  require_range("height_sensor.cone", config.cone_rad, 0.0, kWidestConeRad);
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

double nearest_echo_m(const HeightSensorConfig& config, double below_m, const HeightBeside& beside) {
  if (config.cone_rad == 0.0 || !beside) return below_m;
  double nearest_m = below_m;
  const double reach_m = config.max_m * std::sin(config.cone_rad);
  const int rings = static_cast<int>(std::ceil(reach_m / kRingSpacingM));
  for (int ring = 1; ring <= rings; ++ring) {
    const double radius_m = reach_m * ring / rings;
    const int points = 6 * ring;  // as far apart as the rings
    for (int i = 0; i < points; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / points;
      const double height_m = beside(radius_m * std::cos(angle), radius_m * std::sin(angle));
      if (height_m * std::tan(config.cone_rad) < radius_m) continue;  // outside the cone
      nearest_m = std::min(nearest_m, std::hypot(height_m, radius_m));
    }
  }
  return nearest_m;
}

double height_sigma_m(const HeightSensorConfig& config, double range_m) {
  return std::hypot(config.noise_m, config.noise_per_range * range_m);
}

}  // namespace hedgehop::dynamics
