#include "dynamics/control/alignment.h"

#include <cmath>

#include "sim/fields/quantities.h"

namespace hedgehop::dynamics::control {
namespace {

constexpr double kMinTiltSigmaRad = 1e-5;  // keeps the covariance regular with perfect sensors

}  // namespace

Alignment Alignment::rotated(const Eigen::Quaterniond& rotation) const {
  const Eigen::Matrix3d R_new = rotation.toRotationMatrix().transpose();  // from the old axes to the new ones
  Alignment turned = *this;
  turned.q_WB_est = (q_WB_est * rotation).normalized();
  turned.attitude_covariance = R_new * attitude_covariance * R_new.transpose();
  turned.attitude_by_accelerometer = R_new * attitude_by_accelerometer;
  turned.attitude_by_compass = R_new * attitude_by_compass;
  return turned;
}

void GroundAlignment::add(const sensors::ImuReading& reading) {
  ++imu_count_;
  gyro_sum_ += reading.w_WB_B_meas;
  specific_force_sum_ += reading.specific_force_B_meas;
}

void GroundAlignment::add_heading(double heading_meas_rad) {
  if (heading_count_++ == 0) first_heading_rad_ = heading_meas_rad;
  heading_sum_rad_ += wrap_angle(heading_meas_rad - first_heading_rad_);
}

Alignment GroundAlignment::result(double surveyed_heading_rad, double surveyed_sigma_rad) const {
  const double duration_s = imu_count_ / imu_.rate_hz;
  const sensors::GaussMarkov gyro = sensors::gyro_wander(imu_), accelerometer = sensors::accelerometer_wander(imu_);
  const Eigen::Vector3d f = specific_force_sum_ / imu_count_;
  const double roll_rad = std::atan2(-f.y(), -f.z()), pitch_rad = std::atan2(f.x(), std::hypot(f.y(), f.z()));

  Alignment a;
  a.gyro_bias_est = gyro_sum_ / imu_count_;
  // Of the present bias, which has wandered since its mean.
  a.gyro_bias_sigma_radps =
      std::sqrt(square(gyro.sigma) * gyro.end_less_mean(duration_s) + square(imu_.gyro_noise_density) / duration_s);

  // At rest f = (bias_x, bias_y, -g): the roll error is bias_y / g, the pitch error -bias_x / g.
  const double mean_bias2 = square(imu_.accelerometer_offset_mps2) +
                            square(accelerometer.sigma) * accelerometer.mean_with_mean(duration_s) +
                            square(imu_.accelerometer_noise_density) / duration_s;
  const double mean_with_bias =
      square(imu_.accelerometer_offset_mps2) + square(accelerometer.sigma) * accelerometer.mean_with_end(duration_s);
  a.accelerometer_bias_sigma_mps2 = std::hypot(imu_.accelerometer_offset_mps2, accelerometer.sigma);
  const double tilt2 = mean_bias2 / square(kGravityMps2) + square(imu_.misalignment_rad) + square(kMinTiltSigmaRad);
  a.attitude_by_accelerometer(0, 1) = mean_with_bias / kGravityMps2;
  a.attitude_by_accelerometer(1, 0) = -mean_with_bias / kGravityMps2;

  double heading_rad = surveyed_heading_rad, heading2 = square(surveyed_sigma_rad);
  a.compass_sigma_rad = magnetometer_.offset_rad;
  if (heading_count_ > 0) {
    heading_rad = first_heading_rad_ + heading_sum_rad_ / heading_count_;
    heading2 =
        square(magnetometer_.offset_rad) + square(magnetometer_.noise_rad) / heading_count_ + square(kMinTiltSigmaRad);
    a.attitude_by_compass.z() = -square(magnetometer_.offset_rad);
  }
  a.attitude_covariance.diagonal() << tilt2, tilt2, heading2;
  a.q_WB_est = from_roll_pitch_heading(roll_rad, pitch_rad, heading_rad);
  return a;
}

}  // namespace hedgehop::dynamics::control
