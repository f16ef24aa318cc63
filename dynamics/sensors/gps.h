#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "dynamics/rigid_body.h"
#include "dynamics/sensors/sensor_errors.h"
#include "sim/fields/field.h"

namespace hedgehop::dynamics::sensors {

/// A satellite receiver with latency and a wandering position error. Rate, latency and correlation time are those of
/// [PX4Gazebo2024]. The split of the error into wandering and white parts is an estimate.
struct GpsConfig {
  bool enabled = true;
  double rate_hz = 5.0;
  double latency_s = 0.12;
  double wander_horizontal_m = 1.5, wander_vertical_m = 2.5;  ///< standard deviation of the wandering error
  double wander_time_s = 60.0;                                ///< its correlation time
  double noise_m = 0.2;                                       ///< white, per axis
  double velocity_noise_mps = 0.1;                            ///< white, per axis
  double dropout = 0.0;                                       ///< probability that a fix is missing
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<GpsConfig> auto& c) {
  v("enabled", c.enabled, {.meaning = "whether the receiver has reception"});
  v("rate", c.rate_hz,
    {.unit = "Hz", .at_least = fields::kMinRateHz, .meaning = "fixes per second; divides the physics rate"});
  v("latency", c.latency_s, {.unit = "s", .at_least = 0.0, .at_most = 2.0, .meaning = "age of a fix on arrival"});
  v("wander_horizontal", c.wander_horizontal_m,
    {.unit = "m", .at_least = 0.0, .meaning = "standard deviation per axis of the wandering position error"});
  v("wander_vertical", c.wander_vertical_m,
    {.unit = "m", .at_least = 0.0, .meaning = "standard deviation of the wandering altitude error"});
  v("wander_time", c.wander_time_s, {.unit = "s", .above = 0.0, .meaning = "correlation time of the wandering error"});
  v("noise", c.noise_m, {.unit = "m", .at_least = 0.0, .meaning = "white position noise per axis"});
  v("velocity_noise", c.velocity_noise_mps,
    {.unit = "m/s", .at_least = 0.0, .meaning = "white velocity noise per axis"});
  v("dropout", c.dropout, {.at_least = 0.0, .at_most = 1.0, .meaning = "probability that a fix is missing"});
}

struct GpsFix {
  Eigen::Vector3d p_WB_W_meas = Eigen::Vector3d::Zero();  ///< of one latency ago, m
  Eigen::Vector3d v_WB_W_meas = Eigen::Vector3d::Zero();  ///< of one latency ago, m/s
};

class Gps {
 public:
  /// Throws std::invalid_argument on values out of range. @param physics_dt_s  between calls of observe(), > 0.
  Gps(const GpsConfig& config, double physics_dt_s, uint64_t seed);

  int64_t period() const { return period_; }

  /// Stores the true position and velocity. Must be called on every physics tick.
  void observe(const Eigen::Vector3d& p_WB, const Eigen::Vector3d& v_WB_W);
  /// Returns the fix that arrives on this tick; nullopt without reception, on a drop-out, or before one latency has
  /// passed. Must be called every period() ticks.
  std::optional<GpsFix> read();

 private:
  struct Truth {
    Eigen::Vector3d p_WB, v_WB_W;
  };
  GpsConfig config_;
  double sample_dt_s_;
  int64_t period_;
  RandomStream noise_;
  Eigen::Vector3d wander_sigma_m_, wander_m_;
  std::vector<Truth> past_;  ///< ring buffer as long as the latency
  size_t next_ = 0, count_ = 0;
};

}  // namespace hedgehop::dynamics::sensors
