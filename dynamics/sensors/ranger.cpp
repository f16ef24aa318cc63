#include "dynamics/sensors/ranger.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "sim/fields/bounds.h"
#include "sim/fields/invalid_field.h"

namespace hedgehop::dynamics::sensors {

Ranger::Ranger(const std::string& key, const RangerConfig& config, double physics_dt_s, uint64_t seed)
    : config_(fields::require_bounds(config, key)),
      period_(period_ticks(key + ".rate", config.rate_hz, physics_dt_s)),
      noise_(seed) {
  if (!(config.max_m > config.min_m)) {
    std::ostringstream message;
    message << "must be greater than 'min' (" << config.min_m << " m), got " << config.max_m;
    throw fields::InvalidField(key + ".max", message.str());
  }
  latency_ = std::llround(config.latency_s / physics_dt_s);
  observed_m_.assign(static_cast<size_t>(latency_ / period_) + 1, std::numeric_limits<double>::infinity());
  if (config.offset_m > 0.0) offset_m_ = config.offset_m * noise_.normal();
}

void Ranger::observe(double distance_m) {
  observed_m_[next_] = distance_m;
  next_ = (next_ + 1) % observed_m_.size();
}

std::optional<double> Ranger::read() {
  // Every reading draws the same count of numbers, so that a drop-out does not shift the stream.
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

Eigen::Vector3d beam_direction_B(const RangeFinderConfig& config) {
  fields::require_bounds(config, "range_finder");
  if (config.direction_B.isZero(0.0)) {
    throw fields::InvalidField("range_finder.direction", "must not be zero");
  }
  return config.direction_B.stableNormalized();
}

namespace {

constexpr double kRingSpacingM = 0.5;  // chosen: obstacles on roofs and on the ground are rarely narrower

}  // namespace

double nearest_echo_m(const HeightSensorConfig& config, double below_m, const HeightAtOffset& height_at) {
  if (config.cone_rad == 0.0 || !height_at) return below_m;
  double nearest_m = below_m;
  const double reach_m = config.ranger.max_m * std::sin(config.cone_rad);
  const int rings = static_cast<int>(std::ceil(reach_m / kRingSpacingM));
  for (int ring = 1; ring <= rings; ++ring) {
    const double radius_m = reach_m * ring / rings;
    const int points = 6 * ring;  // with the spacing of the rings
    for (int i = 0; i < points; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / points;
      const double height_m = height_at(radius_m * std::cos(angle), radius_m * std::sin(angle));
      if (height_m * std::tan(config.cone_rad) < radius_m) continue;  // outside the cone
      nearest_m = std::min(nearest_m, std::hypot(height_m, radius_m));
    }
  }
  return nearest_m;
}

}  // namespace hedgehop::dynamics::sensors
