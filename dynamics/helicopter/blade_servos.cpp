#include "dynamics/helicopter/blade_servos.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace hedgehop::dynamics::helicopter {

void check(const ServoConfig& config) {
  if (!(config.lowest_rad < config.highest_rad)) {
    throw std::invalid_argument("a servo's lowest angle must be below its highest, got " +
                                std::to_string(config.lowest_rad) + " and " + std::to_string(config.highest_rad) +
                                " rad");
  }
}

Eigen::Vector2d derivative(const ServoConfig& config, const ServoState& state, double command_rad) {
  const double target = std::clamp(command_rad, config.lowest_rad, config.highest_rad);
  const double rate = std::clamp(state.rate_radps, -config.rate_limit_radps, config.rate_limit_radps);
  const double wn = config.natural_frequency_radps;
  double acceleration = wn * wn * (target - state.position_rad) - 2.0 * config.damping * wn * rate;

  // At the rate limit, the rate does not grow.
  if (rate >= config.rate_limit_radps) acceleration = std::min(acceleration, 0.0);
  if (rate <= -config.rate_limit_radps) acceleration = std::max(acceleration, 0.0);
  return {rate, acceleration};
}

ServoState within_limits(const ServoConfig& config, const ServoState& state) {
  ServoState limited{std::clamp(state.position_rad, config.lowest_rad, config.highest_rad),
                     std::clamp(state.rate_radps, -config.rate_limit_radps, config.rate_limit_radps)};
  if (state.position_rad > config.highest_rad) limited.rate_radps = std::min(limited.rate_radps, 0.0);
  if (state.position_rad < config.lowest_rad) limited.rate_radps = std::max(limited.rate_radps, 0.0);
  return limited;
}

}  // namespace hedgehop::dynamics::helicopter
