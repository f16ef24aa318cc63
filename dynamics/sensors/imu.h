#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "dynamics/rigid_body.h"
#include "dynamics/sensors/sensor_errors.h"
#include "sim/fields/field.h"

namespace hedgehop::dynamics::sensors {

/// Gyros and accelerometers: reading = clamp(misaligned low-pass(truth) + offset + wandering bias + white noise).
/// Noise of an ADIS16448: [FurrerBurriAchtelikSiegwart2016] sec. 5.4; filter, ranges and misalignment are estimates. It
/// has no drop-outs, because it is on the flight computer's bus and the aircraft cannot fly without it.
struct ImuConfig {
  double rate_hz = 100.0;
  double gyro_noise_density = 3.394e-4;        ///< rad/s/sqrt(Hz)
  double gyro_bias_walk = 3.879e-5;            ///< rad/s^2/sqrt(Hz)
  double gyro_bias_time_s = 1000.0;            ///< correlation time of the bias
  double gyro_offset_radps = 0.0087;           ///< standard deviation of the turn-on offset
  double accelerometer_noise_density = 0.004;  ///< m/s^2/sqrt(Hz)
  double accelerometer_bias_walk = 0.006;      ///< m/s^3/sqrt(Hz)
  double accelerometer_bias_time_s = 300.0;
  double accelerometer_offset_mps2 = 0.196;
  double cutoff_hz = 50.0;  ///< -3 dB of the first-order low-pass filter
  double gyro_range_radps = 17.453292519943295;
  double accelerometer_range_mps2 = 176.58;
  double misalignment_rad = 0.0017453292519943295;   ///< standard deviation about each axis of B
  Eigen::Vector3d p_BI_m = Eigen::Vector3d::Zero();  ///< position from the mass center, in B
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<ImuConfig> auto& c) {
  v("rate", c.rate_hz,
    {.unit = "Hz", .at_least = fields::kMinRateHz, .meaning = "readings per second; divides the physics rate"});
  v("gyro_noise", c.gyro_noise_density,
    {.unit = "rad/s/sqrt(Hz)", .at_least = 0.0, .meaning = "white noise density of the gyros"});
  v("gyro_bias_walk", c.gyro_bias_walk,
    {.unit = "rad/s^2/sqrt(Hz)", .at_least = 0.0, .meaning = "noise density that drives the wandering bias"});
  v("gyro_bias_time", c.gyro_bias_time_s,
    {.unit = "s", .above = 0.0, .meaning = "correlation time of the wandering bias"});
  v("gyro_offset", c.gyro_offset_radps,
    {.unit = "rad/s", .at_least = 0.0, .meaning = "standard deviation of the offset drawn at turn-on"});
  v("accelerometer_noise", c.accelerometer_noise_density,
    {.unit = "m/s^2/sqrt(Hz)", .at_least = 0.0, .meaning = "white noise density of the accelerometers"});
  v("accelerometer_bias_walk", c.accelerometer_bias_walk,
    {.unit = "m/s^3/sqrt(Hz)", .at_least = 0.0, .meaning = "noise density that drives the wandering bias"});
  v("accelerometer_bias_time", c.accelerometer_bias_time_s,
    {.unit = "s", .above = 0.0, .meaning = "correlation time of the wandering bias"});
  v("accelerometer_offset", c.accelerometer_offset_mps2,
    {.unit = "m/s^2", .at_least = 0.0, .meaning = "standard deviation of the offset drawn at turn-on"});
  v("cutoff", c.cutoff_hz,
    {.unit = "Hz",
     .at_least = fields::kMinRateHz,
     .meaning = "-3 dB frequency of the low-pass filter; below half the physics rate"});
  v("gyro_range", c.gyro_range_radps, {.unit = "rad/s", .above = 0.0, .meaning = "maximum rate of a reading"});
  v("accelerometer_range", c.accelerometer_range_mps2,
    {.unit = "m/s^2", .above = 0.0, .meaning = "maximum specific force of a reading"});
  v("misalignment", c.misalignment_rad,
    {.unit = "deg", .at_least = 0.0, .at_most = 5.0, .meaning = "standard deviation of the mounting error per axis"});
  v("position", c.p_BI_m, {.unit = "m", .meaning = "position: forward, right, down of the mass center"});
}

struct ImuReading {
  Eigen::Vector3d w_WB_B_meas = Eigen::Vector3d::Zero();            ///< rad/s
  Eigen::Vector3d specific_force_B_meas = Eigen::Vector3d::Zero();  ///< m/s^2; at rest (0, 0, -g)
};

class Imu {
 public:
  /// Throws std::invalid_argument on values out of range. @param physics_dt_s  between calls of observe(), > 0.
  Imu(const ImuConfig& config, double physics_dt_s, uint64_t seed);

  int64_t period() const { return period_; }  ///< physics ticks between readings

  /// Updates the low-pass filter with the true motion. Must be called on every physics tick.
  /// @param w_WB_B  angular velocity, in B. @param f_B  specific force of the mass center, in B.
  void observe(const Eigen::Vector3d& w_WB_B, const Eigen::Vector3d& f_B);
  /// Returns the reading on this tick. Must be called every period() ticks.
  ImuReading read();

  /// Returns the present offset plus wandering bias, which a perfect calibration would remove.
  ImuReading bias() const;

 private:
  ImuConfig config_;
  double dt_s_, sample_dt_s_;
  int64_t period_;
  RandomStream noise_;
  GaussMarkov gyro_wander_model_, accelerometer_wander_model_;
  double filter_;  ///< tan(pi cutoff dt)
  Eigen::Matrix3d R_IB_;
  Eigen::Vector3d gyro_offset_, accelerometer_offset_, gyro_wander_, accelerometer_wander_;
  bool started_ = false;
  Eigen::Vector3d w_in_, f_in_, w_out_, f_out_;  ///< of the filter, on the last tick
};

/// Return the processes of the wandering biases. Their stationary standard deviation is N_b sqrt(tau / 2).
GaussMarkov gyro_wander(const ImuConfig& config);
GaussMarkov accelerometer_wander(const ImuConfig& config);

}  // namespace hedgehop::dynamics::sensors
