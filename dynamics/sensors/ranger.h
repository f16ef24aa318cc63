#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/sensors/sensor_errors.h"
#include "sim/fields/field.h"

namespace hedgehop::dynamics::sensors {

/// Settings that all distance sensors share. The defaults are estimates.
struct RangerConfig {
  bool enabled = true;
  double rate_hz = 50.0;
  double min_m = 0.02, max_m = 50.0;
  double noise_m = 0.01;           ///< white
  double noise_per_range = 0.005;  ///< white, times the range
  double offset_m = 0.0;           ///< standard deviation of the constant error of a flight
  double dropout = 0.01;           ///< probability that a reading is missing
  double latency_s = 0.0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<RangerConfig> auto& c) {
  v("enabled", c.enabled, {.meaning = "whether the vehicle has this sensor"});
  v("rate", c.rate_hz,
    {.unit = "Hz", .at_least = fields::kMinRateHz, .meaning = "readings per second; divides the physics rate"});
  v("min", c.min_m, {.unit = "m", .at_least = 0.0, .meaning = "minimum true range that gives a reading"});
  v("max", c.max_m, {.unit = "m", .above = 0.0, .meaning = "maximum true range that gives a reading"});
  v("noise", c.noise_m, {.unit = "m", .at_least = 0.0, .meaning = "standard deviation of the white noise at range 0"});
  v("noise_per_range", c.noise_per_range,
    {.at_least = 0.0, .at_most = 1.0, .meaning = "standard deviation of a second white noise, divided by the range"});
  v("offset", c.offset_m,
    {.unit = "m", .at_least = 0.0, .meaning = "standard deviation of the offset drawn at turn-on"});
  v("dropout", c.dropout, {.at_least = 0.0, .at_most = 1.0, .meaning = "probability that a reading is missing"});
  v("latency", c.latency_s, {.unit = "s", .at_least = 0.0, .at_most = 2.0, .meaning = "age of a reading on arrival"});
}

class Ranger {
 public:
  /// Throws std::invalid_argument "<key>...." on values out of range. @param key  key of the config, for the message.
  /// @param physics_dt_s  duration of a tick, > 0.
  Ranger(const std::string& key, const RangerConfig& config, double physics_dt_s, uint64_t seed);

  /// Whether the sensor measures on this physics tick, counted from 0. observe() must be called on these ticks only.
  bool observes(int64_t tick) const { return (tick + latency_) % period_ == 0; }
  /// Stores the true distance, m; +inf if there is no surface.
  void observe(double distance_m);
  /// Whether a reading is due on this tick. read() must be called on these ticks, after observe().
  bool due(int64_t tick) const { return tick % period_ == 0; }
  /// Returns the range of one latency ago, m; nullopt if out of range, on a drop-out, if disabled, or before one
  /// latency has passed.
  std::optional<double> read();

 private:
  RangerConfig config_;
  int64_t period_, latency_;  ///< ticks
  RandomStream noise_;
  double offset_m_ = 0.0;
  std::vector<double> observed_m_;  ///< ring buffer of ranges not yet read
  size_t next_ = 0;
};

/// Returns the standard deviation of a reading's white noise at a range, m.
double noise_sigma_m(const RangerConfig& config, double range_m);

/// A single-beam laser, fixed to B.
struct RangeFinderConfig {
  RangerConfig ranger = {.enabled = false, .min_m = 0.1, .max_m = 40.0, .latency_s = 0.01};
  Eigen::Vector3d direction_B = Eigen::Vector3d::UnitX();  ///< of the beam; any length except 0
  Eigen::Vector3d p_BI_m = Eigen::Vector3d::Zero();        ///< origin of the beam, from the mass center, in B
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<RangeFinderConfig> auto& c) {
  describe(v, c.ranger);
  v("direction", c.direction_B, {.meaning = "direction of the beam: forward, right, down; any length except 0"});
  v("position", c.p_BI_m, {.unit = "m", .meaning = "origin of the beam: forward, right, down of the mass center"});
}

/// Returns the distance from a point along a beam to the first surface, m; +inf if there is none within reach.
/// @param p_W  m. @param direction_W  of length 1. @param reach_m  > 0.
using BeamDistance =
    std::function<double(const Eigen::Vector3d& p_W, const Eigen::Vector3d& direction_W, double reach_m)>;

/// Returns the direction of the beam in B, of length 1. Throws std::invalid_argument if the configured direction is
/// zero or a value is out of range.
Eigen::Vector3d beam_direction_B(const RangeFinderConfig& config);

/// A downward range finder: height above the surface below. The defaults are those of a small laser altimeter. A sonar
/// measures the nearest echo in a cone: rate 20 Hz, max 5 m, cone 15 deg [PX4Gazebo2024]; its echo is up to 0.03 s
/// old.
struct HeightSensorConfig {
  RangerConfig ranger;
  double cone_rad = 0.0;  ///< half angle of the measuring cone; 0 for a single beam
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<HeightSensorConfig> auto& c) {
  describe(v, c.ranger);
  v("cone", c.cone_rad,
    {.unit = "deg",
     .at_least = 0.0,
     .at_most = 45.0,
     .meaning = "half angle of the measuring cone: about 15 for a sonar, 0 for a laser"});
}

/// Returns the height above the surface below a point, m; +inf if there is no surface. The point is at the sensor's
/// altitude, displaced north and east from it, m.
using HeightAtOffset = std::function<double(double north_m, double east_m)>;

/// Returns the distance of the first echo, m: that of the nearest point in the cone about the vertical.
/// @param below_m  height above the surface directly below. @param height_at  height at points around the sensor; not
/// called for a single beam. Simplified: surfaces are sampled from above, on rings at most 0.5 m apart; walls at the
/// edge of the cone reflect the sound away.
double nearest_echo_m(const HeightSensorConfig& config, double below_m, const HeightAtOffset& height_at);

}  // namespace hedgehop::dynamics::sensors
