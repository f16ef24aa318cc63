#pragma once

#include <cstdint>
#include <optional>

#include "dynamics/sensors/sensor_errors.h"
#include "sim/fields/field.h"

namespace hedgehop::dynamics::sensors {

/// A tilt-compensated magnetic compass: heading with a constant offset (iron on board, declination) and white noise.
/// Values are estimates: 0.4 mG/sqrt(Hz) in a horizontal field of 215 mG is 0.1 deg/sqrt(Hz) [PX4Gazebo2024]. It has no
/// lag because a magnetometer settles within a few milliseconds, in which the heading changes by less than the noise.
struct MagnetometerConfig {
  bool enabled = true;
  double rate_hz = 50.0;
  double noise_rad = 0.013089969389957471;   ///< white, per reading: 0.75 deg
  double offset_rad = 0.017453292519943295;  ///< standard deviation of the offset drawn at turn-on: 1 deg
  double dropout = 0.0;                      ///< probability that a reading is missing
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<MagnetometerConfig> auto& c) {
  v("enabled", c.enabled, {.meaning = "whether the compass works"});
  v("rate", c.rate_hz,
    {.unit = "Hz", .at_least = fields::kMinRateHz, .meaning = "readings per second; divides the physics rate"});
  v("noise", c.noise_rad, {.unit = "deg", .at_least = 0.0, .at_most = 90.0, .meaning = "white noise of a reading"});
  v("offset", c.offset_rad,
    {.unit = "deg", .at_least = 0.0, .at_most = 90.0, .meaning = "standard deviation of the offset drawn at turn-on"});
  v("dropout", c.dropout, {.at_least = 0.0, .at_most = 1.0, .meaning = "probability that a reading is missing"});
}

class Magnetometer {
 public:
  /// Throws std::invalid_argument on values out of range. @param physics_dt_s  > 0.
  Magnetometer(const MagnetometerConfig& config, double physics_dt_s, uint64_t seed);

  int64_t period() const { return period_; }  ///< physics ticks between readings
  double offset_rad() const { return offset_rad_; }

  /// Returns the heading with its errors, from north to east, -pi..pi; nullopt on a drop-out or if disabled. Must be
  /// called every period() ticks.
  std::optional<double> read(double heading_rad);

 private:
  MagnetometerConfig config_;
  int64_t period_;
  RandomStream noise_;
  double offset_rad_;
};

}  // namespace hedgehop::dynamics::sensors
