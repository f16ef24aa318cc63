#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "dynamics/sensor_noise.h"

namespace hedgehop::dynamics {

/// A laser of one beam, fixed to B, that ranges whatever the beam meets. All numbers are estimates.
struct RangeFinderConfig {
  bool enabled = false;
  Eigen::Vector3d direction_B = Eigen::Vector3d::UnitX();  ///< of the beam; any length but 0
  double rate_hz = 50.0;
  double min_m = 0.1, max_m = 40.0;
  double noise_m = 0.01;           ///< white
  double noise_per_range = 0.005;  ///< white, times the range
  double dropout = 0.01;           ///< probability that a reading is missing
  double latency_s = 0.01;
};
template <class Visitor>
void describe(Visitor& v, RangeFinderConfig& c) {
  v("enabled", c.enabled, {.meaning = "whether there is one"});
  v("direction", c.direction_B, {.meaning = "of the beam: forward, right, down; of any length but 0"});
  v("rate", c.rate_hz, {.unit = "Hz", .above = 0.0, .meaning = "readings a second; divides the physics rate"});
  v("min", c.min_m, {.unit = "m", .at_least = 0.0, .meaning = "shortest range it reads"});
  v("max", c.max_m, {.unit = "m", .above = 0.0, .meaning = "longest range it reads"});
  v("noise", c.noise_m, {.unit = "m", .at_least = 0.0, .meaning = "white noise at range 0"});
  v("noise_per_range", c.noise_per_range,
    {.at_least = 0.0, .at_most = 1.0, .meaning = "white noise that grows with the range, as a share of it"});
  v("dropout", c.dropout, {.at_least = 0.0, .at_most = 1.0, .meaning = "share of readings that are missing"});
  v("latency", c.latency_s,
    {.unit = "s", .at_least = 0.0, .at_most = 2.0, .meaning = "age of a reading when it arrives"});
}

class RangeFinder {
 public:
  /// Throws std::invalid_argument on values out of range. @param physics_dt_s  between calls of feel(), > 0.
  RangeFinder(const RangeFinderConfig& config, double physics_dt_s, uint64_t seed);

  int64_t period() const { return period_; }                           ///< physics ticks between readings
  const Eigen::Vector3d& direction_B() const { return direction_B_; }  ///< of the beam, of length 1

  /// Remembers the true distance along the beam on this physics tick, m; +inf where it meets nothing.
  void feel(double distance_m);
  /// @return the range a latency ago, m; none out of range, on a drop-out, when disabled, or before the first is old
  /// enough. To be called once every period() ticks.
  std::optional<double> read();

 private:
  RangeFinderConfig config_;
  Eigen::Vector3d direction_B_;
  int64_t period_;
  NormalStream noise_;
  std::vector<double> past_m_;  ///< a ring as long as the latency
  size_t next_ = 0;
};

}  // namespace hedgehop::dynamics
