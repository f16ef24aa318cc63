#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "sim/libm/random.h"

/// Errors that the sensors share: random numbers, wandering errors and failures; and their sampling.
namespace hedgehop::dynamics::sensors {

/// Returns three standard normal numbers.
Eigen::Vector3d normal3(RandomStream& random);

/// First-order Gauss-Markov process, sampled exactly: e^(-dt/tau) correlation from step to step.
struct GaussMarkov {
  double sigma = 0.0;               ///< stationary standard deviation, >= 0
  double correlation_time_s = 1.0;  ///< tau, > 0

  /// Factor on the previous value, and standard deviation of the added noise, for a step of dt_s.
  double decay(double dt_s) const;
  double added_sigma(double dt_s) const;

  // For a duration > 0, divided by sigma squared: covariance of the mean with the final value, variance of the mean,
  // variance of the final value minus the mean.
  double mean_with_end(double duration_s) const;
  double mean_with_mean(double duration_s) const;
  double end_less_mean(double duration_s) const {
    return 1.0 - 2.0 * mean_with_end(duration_s) + mean_with_mean(duration_s);
  }
};

/// Returns the period of a sensor's readings in physics ticks.
/// @param key  key of the rate in the config, for the message. @param rate_hz  > 0.
/// Throws std::invalid_argument "<key>: ..." unless the rate divides the physics rate.
int64_t period_ticks(std::string_view key, double rate_hz, double physics_dt_s);

enum class Instrument {
  gyros,
  accelerometers,
  gps,           ///< position of the fix
  gps_velocity,  ///< velocity of the fix
  height_sensor,
  magnetometer,
  barometer,
  range_finder,
  velocimeter
};
inline constexpr size_t kInstruments = 9;

/// A temporary failure of an instrument.
struct SensorFailure {
  enum class Mode {
    off,    ///< no reading; gyros and accelerometers read 0
    stuck,  ///< repeats its last reading
    bias,   ///< `value` is added to component `axis`
    noise   ///< white noise of standard deviation `value` is added to every component
  };
  Instrument instrument = Instrument::gps;
  Mode mode = Mode::off;
  int64_t from_ns = 0, until_ns = 0;  ///< `until_ns` is excluded
  double value = 0.0;
  int axis = 0;
  uint64_t seed = 0;  ///< of the noise stream
};

/// The failures of a flight. Without failures, readings are unchanged.
class SensorFailures {
 public:
  SensorFailures() = default;
  explicit SensorFailures(std::vector<SensorFailure> failures);

  /// Returns the delivered reading; nullopt if there was no reading or the instrument is off. A stuck instrument
  /// delivers its last delivered reading, also if there was no new one; nullopt if it has delivered none. Time must not
  /// decrease.
  std::optional<Eigen::Vector3d> deliver(Instrument instrument, int64_t t_ns, std::optional<Eigen::Vector3d> reading) {
    return failures_.empty() ? reading : with_failures(instrument, t_ns, reading);
  }
  std::optional<double> deliver(Instrument instrument, int64_t t_ns, std::optional<double> reading) {
    if (failures_.empty()) return reading;
    const auto vector = reading ? std::optional(Eigen::Vector3d(*reading, 0.0, 0.0)) : std::nullopt;
    const std::optional<Eigen::Vector3d> delivered = with_failures(instrument, t_ns, vector);
    return delivered ? std::optional(delivered->x()) : std::nullopt;
  }

 private:
  struct Failing {
    SensorFailure failure;
    RandomStream noise;
  };
  std::optional<Eigen::Vector3d> with_failures(Instrument instrument, int64_t t_ns,
                                               std::optional<Eigen::Vector3d> reading);

  std::vector<Failing> failures_;
  std::array<std::optional<Eigen::Vector3d>, kInstruments> last_;  ///< last delivered reading of each
};

}  // namespace hedgehop::dynamics::sensors
