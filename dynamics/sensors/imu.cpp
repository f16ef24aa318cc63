#include "dynamics/sensors/imu.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "sim/fields/bounds.h"
#include "sim/fields/invalid_field.h"

namespace hedgehop::dynamics::sensors {
namespace {

/// Returns one step of a first-order low-pass filter by the bilinear transform, prewarped to -3 dB at the cut-off.
Eigen::Vector3d filtered(double k, const Eigen::Vector3d& out, const Eigen::Vector3d& in_last,
                         const Eigen::Vector3d& in) {
  return ((1.0 - k) * out + k * (in_last + in)) / (1.0 + k);
}

Eigen::Vector3d clamped(const Eigen::Vector3d& v, double range) { return v.cwiseMax(-range).cwiseMin(range); }

}  // namespace

GaussMarkov gyro_wander(const ImuConfig& c) {
  return {c.gyro_bias_walk * std::sqrt(0.5 * c.gyro_bias_time_s), c.gyro_bias_time_s};
}

GaussMarkov accelerometer_wander(const ImuConfig& c) {
  return {c.accelerometer_bias_walk * std::sqrt(0.5 * c.accelerometer_bias_time_s), c.accelerometer_bias_time_s};
}

Imu::Imu(const ImuConfig& config, double physics_dt_s, uint64_t seed)
    : config_(fields::require_bounds(config, "imu")),
      dt_s_(physics_dt_s),
      period_(period_ticks("imu.rate", config.rate_hz, physics_dt_s)),
      noise_(seed),
      gyro_wander_model_(gyro_wander(config)),
      accelerometer_wander_model_(accelerometer_wander(config)),
      filter_(std::tan(std::numbers::pi * config.cutoff_hz * physics_dt_s)) {
  if (config.cutoff_hz * physics_dt_s >= 0.5) {
    throw fields::InvalidField("imu.cutoff", "must be below half the physics rate");
  }
  sample_dt_s_ = static_cast<double>(period_) * dt_s_;
  gyro_offset_ = config.gyro_offset_radps * normal3(noise_);
  accelerometer_offset_ = config.accelerometer_offset_mps2 * normal3(noise_);
  gyro_wander_ = gyro_wander_model_.sigma * normal3(noise_);
  accelerometer_wander_ = accelerometer_wander_model_.sigma * normal3(noise_);
  const Eigen::Vector3d tilt = config.misalignment_rad * normal3(noise_);
  R_IB_ = Eigen::AngleAxisd(tilt.norm(), tilt.stableNormalized()).toRotationMatrix();
}

void Imu::observe(const Eigen::Vector3d& w_WB_B, const Eigen::Vector3d& f_B) {
  // At the sensor's position: Euler and centripetal acceleration, the former by the difference over one tick.
  const Eigen::Vector3d w_dot = started_ ? Eigen::Vector3d((w_WB_B - w_in_) / dt_s_) : Eigen::Vector3d::Zero();
  const Eigen::Vector3d& r = config_.p_BI_m;
  const Eigen::Vector3d f = f_B + w_dot.cross(r) + w_WB_B.cross(w_WB_B.cross(r));
  w_out_ = started_ ? filtered(filter_, w_out_, w_in_, w_WB_B) : w_WB_B;
  f_out_ = started_ ? filtered(filter_, f_out_, f_in_, f) : f;
  w_in_ = w_WB_B;
  f_in_ = f;
  started_ = true;
}

ImuReading Imu::read() {
  const double root_rate = 1.0 / std::sqrt(sample_dt_s_);
  gyro_wander_ = gyro_wander_model_.decay(sample_dt_s_) * gyro_wander_ +
                 gyro_wander_model_.added_sigma(sample_dt_s_) * normal3(noise_);
  accelerometer_wander_ = accelerometer_wander_model_.decay(sample_dt_s_) * accelerometer_wander_ +
                          accelerometer_wander_model_.added_sigma(sample_dt_s_) * normal3(noise_);
  const ImuReading errors = bias();
  const Eigen::Vector3d w =
      R_IB_ * w_out_ + errors.w_WB_B_meas + config_.gyro_noise_density * root_rate * normal3(noise_);
  const Eigen::Vector3d f =
      R_IB_ * f_out_ + errors.specific_force_B_meas + config_.accelerometer_noise_density * root_rate * normal3(noise_);
  return {clamped(w, config_.gyro_range_radps), clamped(f, config_.accelerometer_range_mps2)};
}

ImuReading Imu::bias() const { return {gyro_offset_ + gyro_wander_, accelerometer_offset_ + accelerometer_wander_}; }

}  // namespace hedgehop::dynamics::sensors
