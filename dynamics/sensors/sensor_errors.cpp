#include "dynamics/sensors/sensor_errors.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "sim/fields/invalid_field.h"

namespace hedgehop::dynamics::sensors {

Eigen::Vector3d normal3(RandomStream& random) {
  Eigen::Vector3d v;
  for (int i = 0; i < 3; ++i) v[i] = random.normal();
  return v;
}

double GaussMarkov::decay(double dt_s) const { return std::exp(-dt_s / correlation_time_s); }

double GaussMarkov::added_sigma(double dt_s) const {
  return sigma * std::sqrt(-std::expm1(-2.0 * dt_s / correlation_time_s));
}

// Integrals of the autocorrelation e^(-|t1 - t2| / tau), x = duration / tau.
double GaussMarkov::mean_with_end(double duration_s) const {
  const double x = duration_s / correlation_time_s;
  return -std::expm1(-x) / x;
}

double GaussMarkov::mean_with_mean(double duration_s) const {
  const double x = duration_s / correlation_time_s;
  constexpr double kSeriesBelow = 1e-3;  // below it the difference loses digits; three terms suffice
  return x < kSeriesBelow ? 1.0 - x / 3.0 + x * x / 12.0 : 2.0 * (1.0 - mean_with_end(duration_s)) / x;
}

int64_t period_ticks(std::string_view key, double rate_hz, double physics_dt_s) {
  const double ticks = 1.0 / (rate_hz * physics_dt_s);
  constexpr double kRoundOff = 1e-9;
  if (ticks < 1.0 - kRoundOff || std::abs(ticks - std::round(ticks)) > kRoundOff * ticks) {
    throw fields::InvalidField(std::string(key), std::to_string(rate_hz) + " Hz does not divide the physics rate of " +
                                                     std::to_string(1.0 / physics_dt_s) + " Hz");
  }
  return std::llround(ticks);
}

SensorFailures::SensorFailures(std::vector<SensorFailure> failures) {
  for (const SensorFailure& failure : failures) failures_.push_back({failure, RandomStream(failure.seed)});
}

std::optional<Eigen::Vector3d> SensorFailures::with_failures(Instrument instrument, int64_t t_ns,
                                                             std::optional<Eigen::Vector3d> reading) {
  std::optional<Eigen::Vector3d>& last = last_[static_cast<size_t>(instrument)];
  for (auto& [failure, noise] : failures_) {
    if (failure.instrument != instrument || t_ns < failure.from_ns || t_ns >= failure.until_ns) continue;
    switch (failure.mode) {
      case SensorFailure::Mode::off:
        return std::nullopt;
      case SensorFailure::Mode::stuck:
        return last;
      case SensorFailure::Mode::bias:
        if (reading) (*reading)[failure.axis] += failure.value;
        break;
      case SensorFailure::Mode::noise:
        if (reading) *reading += failure.value * normal3(noise);
        break;
    }
  }
  if (reading) last = reading;
  return reading;
}

}  // namespace hedgehop::dynamics::sensors
