#pragma once

#include <cstdint>
#include <optional>

#include "dynamics/sensors/sensor_errors.h"
#include "sim/fields/field.h"

namespace hedgehop::dynamics::sensors {

/// A barometer: pressure with white noise, a slow error (weather, warming) and a lag (port, converter). Rate and white
/// noise are those of [PX4Gazebo2024]. The slow error, about 1 m of altitude over ten minutes, and the lag are
/// estimates.
struct BarometerConfig {
  bool enabled = false;
  double rate_hz = 50.0;
  double noise_pa = 1.0;         ///< white
  double wander_pa = 12.0;       ///< standard deviation of the wandering error
  double wander_time_s = 600.0;  ///< its correlation time
  double lag_s = 0.02;           ///< time constant of the first-order lag
  double dropout = 0.0;          ///< probability that a reading is missing
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<BarometerConfig> auto& c) {
  v("enabled", c.enabled, {.meaning = "whether the vehicle has a barometer"});
  v("rate", c.rate_hz,
    {.unit = "Hz", .at_least = fields::kMinRateHz, .meaning = "readings per second; divides the physics rate"});
  v("noise", c.noise_pa, {.unit = "Pa", .at_least = 0.0, .meaning = "white noise of a reading"});
  v("wander", c.wander_pa, {.unit = "Pa", .at_least = 0.0, .meaning = "standard deviation of the wandering error"});
  v("wander_time", c.wander_time_s, {.unit = "s", .above = 0.0, .meaning = "correlation time of the wandering error"});
  v("lag", c.lag_s, {.unit = "s", .at_least = 0.0, .at_most = 2.0, .meaning = "time constant of the first-order lag"});
  v("dropout", c.dropout, {.at_least = 0.0, .at_most = 1.0, .meaning = "probability that a reading is missing"});
}

class Barometer {
 public:
  /// Throws std::invalid_argument on values out of range. @param physics_dt_s  between calls of observe(), > 0.
  Barometer(const BarometerConfig& config, double physics_dt_s, uint64_t seed);

  int64_t period() const { return period_; }  ///< physics ticks between readings

  /// Updates the lag with the true altitude. Must be called on every physics tick. @param altitude_m  in a standard
  /// atmosphere whose sea level is W's origin.
  void observe(double altitude_m);
  /// Returns the pressure with its errors, Pa; nullopt on a drop-out. Must be called every period() ticks, after
  /// observe().
  std::optional<double> read();

 private:
  BarometerConfig config_;
  int64_t period_;
  double sample_dt_s_;
  RandomStream noise_;
  double wander_pa_;
  double memory_;                     ///< weight of the last tick's altitude in the lag, 0..1
  std::optional<double> altitude_m_;  ///< output of the lag; nullopt before the first tick
};

/// Returns the process of the wandering error.
GaussMarkov barometer_wander(const BarometerConfig& config);

}  // namespace hedgehop::dynamics::sensors
