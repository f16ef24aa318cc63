#pragma once

#include <cstdint>
#include <optional>

#include "dynamics/sensor_noise.h"

namespace hedgehop::dynamics {

/// A range finder that looks down: height above whatever surface lies below. Noise and drop-outs are estimates; the
/// default range is that of a small laser altimeter (a sonar would reach 5 m at 20 Hz [PX4Gazebo2024]).
struct HeightSensorConfig {
  bool enabled = true;
  double rate_hz = 50.0;
  double min_m = 0.02, max_m = 50.0;
  double noise_m = 0.01;           ///< white
  double noise_per_range = 0.005;  ///< white, times the range
  double dropout = 0.01;           ///< probability that a reading is missing
};
template <class Visitor>
void describe(Visitor& v, HeightSensorConfig& c) {
  v("enabled", c.enabled, {.meaning = "whether it works"});
  v("rate", c.rate_hz, {.unit = "Hz", .above = 0.0, .meaning = "readings a second; divides the physics rate"});
  v("min", c.min_m, {.unit = "m", .at_least = 0.0, .meaning = "shortest range it reads"});
  v("max", c.max_m, {.unit = "m", .above = 0.0, .meaning = "longest range it reads"});
  v("noise", c.noise_m, {.unit = "m", .at_least = 0.0, .meaning = "white noise at range 0"});
  v("noise_per_range", c.noise_per_range,
    {.at_least = 0.0, .at_most = 1.0, .meaning = "white noise that grows with the range, as a share of it"});
  v("dropout", c.dropout, {.at_least = 0.0, .at_most = 1.0, .meaning = "share of readings that are missing"});
}

class HeightSensor {
 public:
  /// Throws std::invalid_argument on values out of range. @param physics_dt_s  > 0.
  HeightSensor(const HeightSensorConfig& config, double physics_dt_s, uint64_t seed);

  int64_t period() const { return period_; }  ///< physics ticks between readings

  /// @param height_above_surface_m  true height; may be +inf.
  /// @return the reading, m; none out of range, on a drop-out or when disabled. To be called once every period() ticks.
  std::optional<double> read(double height_above_surface_m);

 private:
  HeightSensorConfig config_;
  int64_t period_;
  NormalStream noise_;
};

/// Standard deviation of a reading at a range, m.
double height_sigma_m(const HeightSensorConfig& config, double range_m);

}  // namespace hedgehop::dynamics
