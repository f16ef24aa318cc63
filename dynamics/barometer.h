#pragma once

#include <cstdint>

#include "dynamics/sensor_noise.h"

namespace hedgehop::dynamics {

/// A barometer: pressure with white noise and a slow error (weather, warming). Rate and white noise as
/// [PX4Gazebo2024]; the slow error, about 1 m of altitude over ten minutes, is an estimate.
struct BarometerConfig {
  bool enabled = false;
  double rate_hz = 50.0;
  double noise_pa = 1.0;         ///< white
  double wander_pa = 12.0;       ///< standard deviation of the wandering error
  double wander_time_s = 600.0;  ///< its correlation time
};
template <class Visitor>
void describe(Visitor& v, BarometerConfig& c) {
  v("enabled", c.enabled, {.meaning = "whether there is one"});
  v("rate", c.rate_hz, {.unit = "Hz", .above = 0.0, .meaning = "readings a second; divides the physics rate"});
  v("noise", c.noise_pa, {.unit = "Pa", .at_least = 0.0, .meaning = "white noise of a reading"});
  v("wander", c.wander_pa, {.unit = "Pa", .at_least = 0.0, .meaning = "standard deviation of the wandering error"});
  v("wander_time", c.wander_time_s, {.unit = "s", .above = 0.0, .meaning = "correlation time of the wandering error"});
}

class Barometer {
 public:
  /// Throws std::invalid_argument on values out of range. @param physics_dt_s  > 0.
  Barometer(const BarometerConfig& config, double physics_dt_s, uint64_t seed);

  int64_t period() const { return period_; }  ///< physics ticks between readings

  /// @param altitude_m  in a standard atmosphere whose sea level is W's origin. @return pressure with its errors, Pa.
  /// To be called once every period() ticks.
  double read(double altitude_m);

 private:
  BarometerConfig config_;
  int64_t period_;
  double sample_dt_s_;
  NormalStream noise_;
  double wander_pa_;
};

/// The wandering error as a process.
GaussMarkov barometer_wander(const BarometerConfig& config);

}  // namespace hedgehop::dynamics
