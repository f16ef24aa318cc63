#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "dynamics/sensors/imu.h"
#include "dynamics/sensors/magnetometer.h"

namespace hedgehop::dynamics::control {

/// How long the aircraft stands still before take-off, s. Chosen: what autopilots of its size ask for.
inline constexpr double kAlignmentS = 30.0;

/// What a navigation filter knows of attitude and inertial sensors when it starts, and how well. Errors are those of
/// the truth less the estimate; that of the attitude is a small rotation about B's axes, rad.
struct Alignment {
  Eigen::Quaterniond q_WB_est = Eigen::Quaterniond::Identity();
  Eigen::Vector3d gyro_bias_est = Eigen::Vector3d::Zero();              ///< rad/s; the accelerometers' is taken for 0
  Eigen::Matrix3d attitude_covariance = Eigen::Matrix3d::Zero();        ///< rad^2
  Eigen::Matrix3d attitude_by_accelerometer = Eigen::Matrix3d::Zero();  ///< covariance with their bias, rad m/s^2
  Eigen::Vector3d attitude_by_compass = Eigen::Vector3d::Zero();        ///< covariance with the compass offset, rad^2
  double gyro_bias_sigma_radps = 0.0, accelerometer_bias_sigma_mps2 = 0.0, compass_sigma_rad = 0.0;

  /// The same after a rotation of B, in B as it was, that the gyros have followed.
  Alignment rotated(const Eigen::Quaterniond& rotation) const;
};

/// Aligns an aircraft that stands still on level ground, by the readings of `kAlignmentS`: the gyros' bias is the mean
/// of their readings; the mean specific force is taken for gravity alone, so that the accelerometers' bias, which
/// standing still does not show, tilts the attitude; the heading is the mean of the magnetometer's.
class GroundAlignment {
 public:
  /// @param imu, magnetometer  of the aircraft: what the sensors are known to err by.
  GroundAlignment(const sensors::ImuConfig& imu, const sensors::MagnetometerConfig& magnetometer)
      : imu_(imu), magnetometer_(magnetometer) {}

  /// A reading of the IMU. At least one is needed.
  void add(const sensors::ImuReading& reading);
  /// A reading of the magnetometer, from north to east.
  void add_heading(double heading_meas_rad);
  /// @param surveyed_heading_rad  in place of the magnetometer's where none was read, by marks on the ground.
  /// @param surveyed_sigma_rad  its standard deviation, > 0.
  Alignment result(double surveyed_heading_rad, double surveyed_sigma_rad) const;

 private:
  sensors::ImuConfig imu_;
  sensors::MagnetometerConfig magnetometer_;
  int imu_count_ = 0, heading_count_ = 0;
  Eigen::Vector3d gyro_sum_ = Eigen::Vector3d::Zero(), specific_force_sum_ = Eigen::Vector3d::Zero();
  double first_heading_rad_ = 0.0, heading_sum_rad_ = 0.0;  ///< the sum counts from the first
};

}  // namespace hedgehop::dynamics::control
