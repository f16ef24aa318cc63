#include "dynamics/control/alignment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/dynamics/control/closed_loop.h"

namespace hedgehop::dynamics::control {
namespace {

constexpr double kAlignmentDeg = std::numbers::pi / 180.0;

/// Returns the small rotation about B's axes from the estimate to the truth, rad.
Eigen::Vector3d rotation_between(const Eigen::Quaterniond& q_est, const Eigen::Quaterniond& q_true) {
  const Eigen::AngleAxisd error(q_est.conjugate() * q_true);
  return wrap_angle(error.angle()) * error.axis();
}

Eigen::Quaterniond about_down(double heading_rad) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()));
}

TEST(GroundAlignment, AccelerometerBiasTiltsTheAttitudeAndGyroBiasIsEstimated) {
  const Eigen::Vector3d gyro_bias(0.01, -0.02, 0.005), bias(0.2, -0.3, 0.1);
  GroundAlignment ground({}, {});
  for (int i = 0; i < 100; ++i) ground.add({gyro_bias, bias + Eigen::Vector3d(0.0, 0.0, -kGravityMps2)});
  ground.add_heading(0.5);
  const Alignment a = ground.result(9.0, 1.0);
  EXPECT_LT((a.gyro_bias_est - gyro_bias).norm(), 1e-12);
  // The estimate assumes that the specific force is gravity: only an acceleration of a wrong magnitude remains.
  const Eigen::Vector3d f_W = a.q_WB_est * Eigen::Vector3d(bias.x(), bias.y(), bias.z() - kGravityMps2);
  EXPECT_NEAR(f_W.head<2>().norm(), 0.0, 1e-12);
  EXPECT_NEAR(to_roll_pitch_heading(a.q_WB_est)[2], 0.5, 1e-12);
}

TEST(GroundAlignment, HeadingsAroundSouthHaveSouthAsTheirMean) {
  GroundAlignment ground({}, {});
  ground.add({Eigen::Vector3d::Zero(), {0.0, 0.0, -kGravityMps2}});
  for (const double off_rad : {0.02, -0.02, 0.01, -0.01}) {
    ground.add_heading(wrap_angle(std::numbers::pi + off_rad));
  }
  EXPECT_NEAR(std::abs(to_roll_pitch_heading(ground.result(0.0, 1.0).q_WB_est)[2]), std::numbers::pi, 1e-12);
}

TEST(GroundAlignment, WithoutAMagnetometerTheHeadingIsSurveyed) {
  GroundAlignment ground({}, {});
  ground.add({Eigen::Vector3d::Zero(), {0.0, 0.0, -kGravityMps2}});
  const Alignment a = ground.result(1.25, 0.03);
  EXPECT_NEAR(to_roll_pitch_heading(a.q_WB_est)[2], 1.25, 1e-12);
  EXPECT_NEAR(std::sqrt(a.attitude_covariance(2, 2)), 0.03, 1e-12);
  EXPECT_EQ(a.attitude_by_compass.norm(), 0.0);
}

// Errors of attitude (3), accelerometer bias (3) and compass offset (1) against their joint covariance, which tests the
// correlations: given the bias, the tilt is ten times more accurate.
TEST(GroundAlignment, ErrorsAreThoseOfTheJointCovariance) {
  sensors::ImuConfig imu_config;  // smaller biases than usual: products of tilts stay below the heading noise
  imu_config.accelerometer_offset_mps2 = 0.05;
  imu_config.accelerometer_bias_walk = 0.002;
  imu_config.misalignment_rad = 0.01 * kAlignmentDeg;
  const sensors::MagnetometerConfig magnetometer_config;
  constexpr int kFlights = 400, kImuReadings = 3000, kHeadings = 1500;
  constexpr double kDt = 0.002, kHeadingRad = -2.0;
  double joint = 0.0, gyros = 0.0;
  for (uint64_t seed = 1; seed <= kFlights; ++seed) {
    sensors::Imu imu(imu_config, kDt, stream_seed(seed, "imu"));
    sensors::Magnetometer magnetometer(magnetometer_config, kDt, stream_seed(seed, "magnetometer"));
    GroundAlignment ground(imu_config, magnetometer_config);
    imu.observe(Eigen::Vector3d::Zero(), {0.0, 0.0, -kGravityMps2});
    for (int i = 0; i < kImuReadings; ++i) ground.add(imu.read());
    for (int i = 0; i < kHeadings; ++i) ground.add_heading(magnetometer.read(kHeadingRad).value());
    const Alignment a = ground.result(0.0, 1.0);

    Eigen::Matrix<double, 7, 7> P = Eigen::Matrix<double, 7, 7>::Zero();
    P.topLeftCorner<3, 3>() = a.attitude_covariance;
    P.block<3, 3>(3, 3).diagonal().setConstant(a.accelerometer_bias_sigma_mps2 * a.accelerometer_bias_sigma_mps2);
    P(6, 6) = a.compass_sigma_rad * a.compass_sigma_rad;
    P.block<3, 3>(0, 3) = a.attitude_by_accelerometer;
    P.block<3, 3>(3, 0) = a.attitude_by_accelerometer.transpose();
    P.block<3, 1>(0, 6) = a.attitude_by_compass;
    P.block<1, 3>(6, 0) = a.attitude_by_compass.transpose();
    Eigen::Matrix<double, 7, 1> error;
    error << rotation_between(a.q_WB_est, about_down(kHeadingRad)), imu.bias().specific_force_B_meas,
        magnetometer.offset_rad();
    joint += error.dot(P.ldlt().solve(error));
    gyros += ((imu.bias().w_WB_B_meas - a.gyro_bias_est) / a.gyro_bias_sigma_radps).squaredNorm();
  }
  RecordProperty("joint", std::to_string(joint / (7 * kFlights)));
  RecordProperty("gyros", std::to_string(gyros / (3 * kFlights)));
  // Chi-square of n degrees of freedom: n within four times sqrt(2 n).
  EXPECT_NEAR(joint, 7.0 * kFlights, 4.0 * std::sqrt(2.0 * 7.0 * kFlights));
  EXPECT_NEAR(gyros, 3.0 * kFlights, 4.0 * std::sqrt(2.0 * 3.0 * kFlights));
}

TEST(GroundAlignment, InitialAttitudeErrorMatchesItsCovariance) {
  constexpr int kFlights = 200;
  double chi_square = 0.0;
  for (int i = 1; i <= kFlights; ++i) {
    Loop loop;  // a helicopter, which banks in a hover
    loop.heading_rad = 0.02 * i;
    loop.seed = static_cast<uint64_t>(i);
    const Sample start = fly(loop, 0.01, [](double) { return PositionSetpoint{{0.0, 0.0, -10.0}, 0.0}; }).front();
    chi_square += start.attitude_error().cwiseQuotient(start.estimate.sigma_attitude_B_rad).squaredNorm();
  }
  RecordProperty("attitude", std::to_string(chi_square / (3 * kFlights)));
  EXPECT_NEAR(chi_square, 3.0 * kFlights, 4.0 * std::sqrt(2.0 * 3.0 * kFlights));
}

TEST(Alignment, RotationMeasuredByTheGyrosRotatesTheError) {
  Alignment before;
  before.q_WB_est = about_down(0.7);
  before.attitude_covariance.diagonal() << 4e-4, 1e-4, 9e-4;
  before.attitude_by_accelerometer(0, 1) = 3e-3;
  const Eigen::Quaterniond rotation(Eigen::AngleAxisd(0.8, Eigen::Vector3d(1.0, 2.0, -0.5).normalized()));
  const Alignment after = before.rotated(rotation);

  // One standard deviation along each old axis, expressed after the rotation.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    constexpr double kSmall = 1e-6;
    const Eigen::Quaterniond q_true =
        before.q_WB_est * Eigen::Quaterniond(Eigen::AngleAxisd(kSmall, Eigen::Vector3d::Unit(axis)));
    const Eigen::Vector3d error = rotation_between(after.q_WB_est, q_true * rotation) / kSmall;
    covariance += before.attitude_covariance(axis, axis) * error * error.transpose();
    if (axis == 0) {
      EXPECT_LT((after.attitude_by_accelerometer.col(1) - 3e-3 * error).norm(), 1e-11);
    }
  }
  EXPECT_LT((after.attitude_covariance - covariance).norm(), 1e-8 * covariance.norm());
}

}  // namespace
}  // namespace hedgehop::dynamics::control
