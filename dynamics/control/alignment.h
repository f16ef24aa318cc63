#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "dynamics/sensors/imu.h"
#include "dynamics/sensors/magnetometer.h"

namespace hedgehop::dynamics::control {

/// Time at rest before take-off, s. Chosen: typical of autopilots for aircraft of this size.
inline constexpr double kAlignmentS = 30.0;

/// Initial estimate of attitude and sensor biases for a navigation filter, with its covariance. Errors are truth minus
/// estimate; the attitude error is a small rotation about B's axes, rad.
struct Alignment {
  Eigen::Quaterniond q_WB_est = Eigen::Quaterniond::Identity();
  Eigen::Vector3d gyro_bias_est = Eigen::Vector3d::Zero();        ///< rad/s; that of the accelerometers is assumed 0
  Eigen::Matrix3d attitude_covariance = Eigen::Matrix3d::Zero();  ///< rad^2
  Eigen::Matrix3d attitude_by_accelerometer =
      Eigen::Matrix3d::Zero();  ///< covariance with the accelerometers' bias, rad m/s^2
  Eigen::Vector3d attitude_by_compass = Eigen::Vector3d::Zero();  ///< covariance with the compass offset, rad^2
  double gyro_bias_sigma_radps = 0.0, accelerometer_bias_sigma_mps2 = 0.0, compass_sigma_rad = 0.0;

  /// Returns the alignment after a rotation of B, given in the previous B, that the gyros have measured.
  Alignment rotated(const Eigen::Quaterniond& rotation) const;
};

/// Alignment of an aircraft at rest on level ground, from the readings of `kAlignmentS`. The gyro bias is the mean of
/// the gyro readings. The mean specific force is assumed to be gravity alone, so the accelerometer bias, which cannot
/// be observed at rest, tilts the attitude. The heading is the mean of the magnetometer readings.
class GroundAlignment {
 public:
  /// @param imu, magnetometer  the aircraft's sensors, which give the error model.
  GroundAlignment(const sensors::ImuConfig& imu, const sensors::MagnetometerConfig& magnetometer)
      : imu_(imu), magnetometer_(magnetometer) {}

  /// Adds a reading of the IMU. At least one is required.
  void add(const sensors::ImuReading& reading);
  /// Adds a reading of the magnetometer, from north to east.
  void add_heading(double heading_meas_rad);
  /// @param surveyed_heading_rad  heading by marks on the ground, used if the magnetometer gave no reading.
  /// @param surveyed_sigma_rad  its standard deviation, > 0.
  Alignment result(double surveyed_heading_rad, double surveyed_sigma_rad) const;

 private:
  sensors::ImuConfig imu_;
  sensors::MagnetometerConfig magnetometer_;
  int imu_count_ = 0, heading_count_ = 0;
  Eigen::Vector3d gyro_sum_ = Eigen::Vector3d::Zero(), specific_force_sum_ = Eigen::Vector3d::Zero();
  double first_heading_rad_ = 0.0, heading_sum_rad_ = 0.0;  ///< sum of the differences from the first
};

}  // namespace hedgehop::dynamics::control
