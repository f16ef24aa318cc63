#include "dynamics/sensors/gps.h"

#include <algorithm>
#include <cmath>

#include "sim/fields/bounds.h"

namespace hedgehop::dynamics::sensors {

Gps::Gps(const GpsConfig& config, double physics_dt_s, uint64_t seed)
    : config_(fields::require_bounds(config, "gps")),
      period_(period_ticks("gps.rate", config.rate_hz, physics_dt_s)),
      noise_(seed) {
  sample_dt_s_ = static_cast<double>(period_) * physics_dt_s;
  past_.resize(static_cast<size_t>(std::llround(config.latency_s / physics_dt_s)) + 1);
  wander_sigma_m_ << config.wander_horizontal_m, config.wander_horizontal_m, config.wander_vertical_m;
  wander_m_ = wander_sigma_m_.cwiseProduct(normal3(noise_));
}

void Gps::observe(const Eigen::Vector3d& p_WB, const Eigen::Vector3d& v_WB_W) {
  past_[next_] = {p_WB, v_WB_W};
  next_ = (next_ + 1) % past_.size();
  count_ = std::min(count_ + 1, past_.size());
}

std::optional<GpsFix> Gps::read() {
  const GaussMarkov unit{1.0, config_.wander_time_s};
  wander_m_ = unit.decay(sample_dt_s_) * wander_m_ +
              unit.added_sigma(sample_dt_s_) * wander_sigma_m_.cwiseProduct(normal3(noise_));
  const Eigen::Vector3d p_noise = config_.noise_m * normal3(noise_);
  const Eigen::Vector3d v_noise = config_.velocity_noise_mps * normal3(noise_);
  const bool lost = config_.dropout > 0.0 && noise_.chance(config_.dropout);
  if (lost || !config_.enabled || count_ < past_.size()) return std::nullopt;
  const Truth& then = past_[next_];  // the oldest
  return GpsFix{then.p_WB + wander_m_ + p_noise, then.v_WB_W + v_noise};
}

}  // namespace hedgehop::dynamics::sensors
