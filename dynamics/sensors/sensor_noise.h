#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <string_view>

/// What the sensors share: a stream of random numbers, an error that wanders, a sampling clock.
namespace hedgehop::dynamics::sensors {

/// Standard normal numbers from one seeded generator; equal seeds give equal sequences.
class NormalStream {
 public:
  explicit NormalStream(uint64_t seed) : generator_(seed) {}
  double draw() { return normal_(generator_); }
  Eigen::Vector3d draw3();
  /// True with probability `p`, 0..1.
  bool chance(double p);

 private:
  std::mt19937_64 generator_;
  std::normal_distribution<double> normal_;
};

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
