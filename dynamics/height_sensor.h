#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "dynamics/sensor_noise.h"

namespace hedgehop::dynamics {

/// A range finder that looks down: height above whatever surface lies below. Noise and drop-outs are estimates; the
/// defaults are those of a small laser altimeter. A sonar hears the nearest echo in a cone: rate 20 Hz, max 5 m, cone
/// 15 deg [PX4Gazebo2024].
struct HeightSensorConfig {
  bool enabled = true;
  double rate_hz = 50.0;
  double min_m = 0.02, max_m = 50.0;
  double noise_m = 0.01;           ///< white
  double noise_per_range = 0.005;  ///< white, times the range
  double dropout = 0.01;           ///< probability that a reading is missing
  double cone_rad = 0.0;           ///< half angle of the cone it listens in; 0 for a single beam
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
  v("cone", c.cone_rad,
    {.unit = "deg",
     .at_least = 0.0,
     .at_most = 45.0,
     .meaning = "half angle of the cone whose nearest echo it reads: about 15 for a sonar, 0 for a laser"});
}

/// Height of a point above the surface below it, m; +inf above nothing. The point lies level with the sensor, so far to
/// the north and east of it, m.
using HeightBeside = std::function<double(double north_m, double east_m)>;

/// Returns the distance of what the sensor hears first, m: the nearest point in its cone about the plumb line.
/// @param below_m  height above the surface right below. @param beside  of the surfaces round about; none is asked for
/// a single beam. Simplified: surfaces are seen from above, on rings at most 0.5 m apart; walls beside the cone reflect
/// the sound away.
double nearest_echo_m(const HeightSensorConfig& config, double below_m, const HeightBeside& beside);

class HeightSensor {
 public:
  /// Throws std::invalid_argument on values out of range. @param physics_dt_s  > 0.
  HeightSensor(const HeightSensorConfig& config, double physics_dt_s, uint64_t seed);

  int64_t period() const { return period_; }  ///< physics ticks between readings

  /// @param height_above_surface_m  true height, for a cone nearest_echo_m(); may be +inf.
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
