#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string_view>

#include "sim/libm/random.h"

/// What the sensors share: an error that wanders, a sampling clock.
namespace hedgehop::dynamics::sensors {

/// Returns three standard normal numbers.
Eigen::Vector3d normal3(RandomStream& random);

/// First-order Gauss-Markov process, sampled exactly: e^(-dt/tau) correlation from step to step.
struct GaussMarkov {
  double sigma = 0.0;               ///< stationary standard deviation, >= 0
  double correlation_time_s = 1.0;  ///< tau, > 0

  /// Factor on the old value, and standard deviation of what is added, in a step of dt_s.
  double decay(double dt_s) const;
  double added_sigma(double dt_s) const;

  // Over a time > 0, as shares of sigma squared: covariance of the mean with the value at the end, variance of the
  // mean, variance of the value at the end less the mean.
  double mean_with_end(double duration_s) const;
  double mean_with_mean(double duration_s) const;
  double end_less_mean(double duration_s) const {
    return 1.0 - 2.0 * mean_with_end(duration_s) + mean_with_mean(duration_s);
  }
};

/// Returns every how many physics ticks a sensor reads.
/// @param key  of the rate in the config, for the message. @param rate_hz  > 0.
/// Throws std::invalid_argument "<key>: ..." unless the rate divides the physics rate.
int64_t period_ticks(std::string_view key, double rate_hz, double physics_dt_s);

}  // namespace hedgehop::dynamics::sensors
