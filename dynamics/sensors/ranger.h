#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/sensors/sensor_noise.h"
#include "sim/fields/field.h"

namespace hedgehop::dynamics::sensors {

/// What all instruments that measure a distance share, whatever they send out. The numbers are estimates.
struct RangerConfig {
  bool enabled = true;
  double rate_hz = 50.0;
  double min_m = 0.02, max_m = 50.0;
  double noise_m = 0.01;           ///< white
  double noise_per_range = 0.005;  ///< white, times the range
  double offset_m = 0.0;           ///< standard deviation of the error that stays for a flight
  double dropout = 0.01;           ///< probability that a reading is missing
  double latency_s = 0.0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<RangerConfig> auto& c) {
  v("enabled", c.enabled, {.meaning = "whether there is one"});
  v("rate", c.rate_hz,
    {.unit = "Hz", .at_least = fields::kMinRateHz, .meaning = "readings a second; divides the physics rate"});
  v("min", c.min_m, {.unit = "m", .at_least = 0.0, .meaning = "shortest range it reads"});
  v("max", c.max_m, {.unit = "m", .above = 0.0, .meaning = "longest range it reads"});
  v("noise", c.noise_m, {.unit = "m", .at_least = 0.0, .meaning = "white noise at range 0"});
  v("noise_per_range", c.noise_per_range,
    {.at_least = 0.0, .at_most = 1.0, .meaning = "white noise that grows with the range, as a share of it"});
  v("offset", c.offset_m,
    {.unit = "m", .at_least = 0.0, .meaning = "standard deviation of the offset drawn at turn-on"});
  v("dropout", c.dropout, {.at_least = 0.0, .at_most = 1.0, .meaning = "share of readings that are missing"});
  v("latency", c.latency_s,
    {.unit = "s", .at_least = 0.0, .at_most = 2.0, .meaning = "age of a reading when it arrives"});
}

class Ranger {
 public:
  /// Throws std::invalid_argument "<key>...." on values out of range. @param key  of the config, for the message.
  /// @param physics_dt_s  the duration of a tick, > 0.
  Ranger(const std::string& key, const RangerConfig& config, double physics_dt_s, uint64_t seed);

  /// Whether it measures on this physics tick, counted from 0: then, and only then, observe() is called.
  bool observes(int64_t tick) const { return (tick + latency_) % period_ == 0; }
  /// Takes in the true distance, m; +inf where there is nothing.
  void observe(double distance_m);
  /// Whether a reading is due on this tick: then read() is called, after observe().
  bool due(int64_t tick) const { return tick % period_ == 0; }
  /// @return the range a latency ago, m; none out of range, on a drop-out, when disabled, or before the first is old
  /// enough.
  std::optional<double> read();

 private:
  RangerConfig config_;
  int64_t period_, latency_;  ///< ticks
  RandomStream noise_;
  double offset_m_ = 0.0;
  std::vector<double> observed_m_;  ///< a ring of ranges observed and not yet read
  size_t next_ = 0;
};

/// Standard deviation of a reading's white noise at a range, m.
double noise_sigma_m(const RangerConfig& config, double range_m);

}  // namespace hedgehop::dynamics::sensors
