#include "dynamics/sensors/imu.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/dynamics/recorded_check.h"

namespace hedgehop::dynamics::sensors {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kSigmaTolerance = 0.03;  // of a standard deviation; standard error below 0.5 %

ImuConfig only_white() {
  ImuConfig c;
  c.gyro_bias_walk = c.gyro_offset_radps = c.accelerometer_bias_walk = c.accelerometer_offset_mps2 = 0.0;
  c.misalignment_rad = 0.0;
  c.cutoff_hz = 30.0;  // below half of 100 Hz, the physics rate of some tests
  return c;
}

ImuConfig no_noise() {
  ImuConfig c = only_white();
  c.gyro_noise_density = c.accelerometer_noise_density = 0.0;
  return c;
}

const Eigen::Vector3d kLevelRest{0.0, 0.0, -kGravityMps2};

struct Rms {
  double gyro = 0.0, accelerometer = 0.0;
};

Rms white_level(double rate_hz) {
  ImuConfig c = only_white();
  c.rate_hz = rate_hz;
  Imu imu(c, 1.0 / rate_hz / 2.0, 7);
  constexpr int kCount = 40000;  // on three axes
  double w2 = 0.0, f2 = 0.0;
  for (int i = 0; i < kCount; ++i) {
    imu.observe(Eigen::Vector3d::Zero(), kLevelRest);
    const ImuReading r = imu.read();
    w2 += r.w_WB_B_meas.squaredNorm();
    f2 += (r.specific_force_B_meas - kLevelRest).squaredNorm();
  }
  return {std::sqrt(w2 / (3 * kCount)), std::sqrt(f2 / (3 * kCount))};
}

// Check AS2.
TEST(Imu, AS2_WhiteNoiseHasTheDensitysLevelAtAnyRate) {
  const Rms at_100 = white_level(100.0), at_500 = white_level(500.0);
  expect_recorded_relative("gyro white noise at 100 Hz, rad/s", at_100.gyro, 3.394e-3, kSigmaTolerance);
  expect_recorded_relative("accelerometer white noise at 100 Hz, m/s2", at_100.accelerometer, 0.0400, kSigmaTolerance);
  expect_recorded_relative("gyro, 500 Hz over 100 Hz", at_500.gyro / at_100.gyro, 2.236, kSigmaTolerance);
  expect_recorded_relative("accelerometer, 500 Hz over 100 Hz", at_500.accelerometer / at_100.accelerometer, 2.236,
                           kSigmaTolerance);
}

TEST(Imu, AS2_BiasesHaveThePublishedSigma) {
  ImuConfig c = no_noise();
  c.gyro_bias_walk = ImuConfig().gyro_bias_walk;
  c.accelerometer_bias_walk = ImuConfig().accelerometer_bias_walk;
  constexpr int kFlights = 35000;  // on three axes
  double gyro2 = 0.0, accelerometer2 = 0.0;
  for (int i = 0; i < kFlights; ++i) {
    const ImuReading b = Imu(c, 0.01, static_cast<uint64_t>(i) + 1).bias();
    gyro2 += b.w_WB_B_meas.squaredNorm();
    accelerometer2 += b.specific_force_B_meas.squaredNorm();
  }
  expect_recorded_relative("gyro bias, rad/s", std::sqrt(gyro2 / (3 * kFlights)), 8.67e-4, kSigmaTolerance);
  expect_recorded_relative("accelerometer bias, m/s2", std::sqrt(accelerometer2 / (3 * kFlights)), 0.0735,
                           kSigmaTolerance);
}

// Check AS3.
TEST(Imu, AS3_AllanDeviationOfTheGyroIsTheDensityAtOneSecondAndFallsWithTheRoot) {
  ImuConfig c = only_white();
  Imu imu(c, 0.01, 11);
  constexpr int kSeconds = 4000;
  std::vector<double> mean_1s, mean_4s;
  for (int s = 0; s < kSeconds; ++s) {
    double sum = 0.0;
    for (int i = 0; i < 100; ++i) {
      imu.observe(Eigen::Vector3d::Zero(), kLevelRest);
      sum += imu.read().w_WB_B_meas.x();
    }
    mean_1s.push_back(sum / 100.0);
    if (s % 4 == 3) mean_4s.push_back((mean_1s[s] + mean_1s[s - 1] + mean_1s[s - 2] + mean_1s[s - 3]) / 4.0);
  }
  const auto allan = [](const std::vector<double>& mean) {
    double sum = 0.0;
    for (size_t i = 1; i < mean.size(); ++i) sum += std::pow(mean[i] - mean[i - 1], 2);
    return std::sqrt(sum / (2.0 * static_cast<double>(mean.size() - 1)));
  };
  expect_recorded_relative("Allan deviation at 1 s, rad/s", allan(mean_1s), 3.4e-4, 0.05);
  expect_recorded("Allan deviation, 1 s over 4 s", allan(mean_1s) / allan(mean_4s), 2.0, 0.15);
}

TEST(Imu, WanderingBiasIsStationaryWithItsCorrelationTime) {
  ImuConfig c = no_noise();
  c.gyro_bias_walk = 3.879e-5;
  c.accelerometer_bias_walk = 0.006;
  c.accelerometer_bias_time_s = 3.0;  // short, so that the decay is visible
  constexpr int kFlights = 4000;
  double gyro2 = 0.0, first2 = 0.0, last2 = 0.0, product = 0.0;
  for (int i = 0; i < kFlights; ++i) {
    Imu imu(c, 0.01, static_cast<uint64_t>(i) + 1);
    imu.observe(Eigen::Vector3d::Zero(), kLevelRest);
    gyro2 += imu.read().w_WB_B_meas.squaredNorm();
    const Eigen::Vector3d first = imu.bias().specific_force_B_meas;
    for (int k = 0; k < 100; ++k) imu.read();
    const Eigen::Vector3d last = imu.bias().specific_force_B_meas;
    first2 += first.squaredNorm(), last2 += last.squaredNorm(), product += first.dot(last);
  }
  EXPECT_NEAR(std::sqrt(gyro2 / (3 * kFlights)), 8.67e-4, kSigmaTolerance * 8.67e-4);
  const double sigma = 0.006 * std::sqrt(1.5);
  EXPECT_NEAR(std::sqrt(first2 / (3 * kFlights)), sigma, kSigmaTolerance * sigma);
  EXPECT_NEAR(std::sqrt(last2 / (3 * kFlights)), sigma, kSigmaTolerance * sigma);
  EXPECT_NEAR(product / first2, std::exp(-1.0 / 3.0), 0.03);
}

TEST(Imu, TurnOnOffsetsHaveTheConfiguredSigma) {
  ImuConfig c = no_noise();
  c.gyro_offset_radps = 0.0087;
  c.accelerometer_offset_mps2 = 0.196;
  constexpr int kFlights = 4000;
  double gyro2 = 0.0, accelerometer2 = 0.0;
  for (int i = 0; i < kFlights; ++i) {
    const ImuReading b = Imu(c, 0.01, static_cast<uint64_t>(i)).bias();
    gyro2 += b.w_WB_B_meas.squaredNorm();
    accelerometer2 += b.specific_force_B_meas.squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(gyro2 / (3 * kFlights)), 0.0087, kSigmaTolerance * 0.0087);
  EXPECT_NEAR(std::sqrt(accelerometer2 / (3 * kFlights)), 0.196, kSigmaTolerance * 0.196);
}

// Check AS5.
TEST(Imu, AS5_MeasuresCentripetalAndEulerAccelerationAtItsPosition) {
  ImuConfig c = no_noise();
  c.p_BI_m = {0.1, 0.0, 0.0};
  Imu spinning(c, 0.002, 1);
  for (int i = 0; i < 200; ++i) spinning.observe({0.0, 0.0, 2.0}, kLevelRest);
  expect_recorded("f_x at 2 rad/s, 0.1 m off, m/s2", spinning.read().specific_force_B_meas.x(), -0.4, 1e-9);

  Imu rest(c, 0.002, 1);
  rest.observe(Eigen::Vector3d::Zero(), kLevelRest);
  const Eigen::Vector3d at_rest = rest.read().specific_force_B_meas;
  EXPECT_EQ(at_rest.head<2>().norm(), 0.0);
  expect_recorded("f_z at rest, m/s2", at_rest.z(), -9.81, 1e-12);

  // Yaw acceleration of 3 rad/s2 from rest: 0.3 m/s2 to the right.
  Imu turning(c, 0.002, 1);
  for (int i = 0; i <= 200; ++i) turning.observe({0.0, 0.0, 3.0 * 0.002 * i}, kLevelRest);
  EXPECT_NEAR(turning.read().specific_force_B_meas.y(), 0.3, 1e-3);
}

// Check AS6: at the cut-off, 2 % more frequency changes the gain by 1 %.
TEST(Imu, AS6_FilterGainIsMinusThreeDecibelsAtItsCutoff) {
  for (const double cutoff_hz : {30.0, 50.0, 80.0}) {
    for (const double physics_hz : {500.0, 1000.0}) {
      ImuConfig c = no_noise();
      c.cutoff_hz = cutoff_hz;
      Imu imu(c, 1.0 / physics_hz, 1);
      double in2 = 0.0, out2 = 0.0;
      for (int i = 0; i < 3000; ++i) {
        const double in = std::sin(2.0 * std::numbers::pi * cutoff_hz * i / physics_hz);
        imu.observe({in, 0.0, 0.0}, kLevelRest);
        if (i < 1000) continue;
        in2 += in * in;
        out2 += std::pow(imu.read().w_WB_B_meas.x(), 2);
      }
      const auto hz = [](double f) { return std::to_string(static_cast<int>(f)) + " Hz"; };
      expect_recorded("gain at a cut-off of " + hz(cutoff_hz) + ", steps at " + hz(physics_hz), std::sqrt(out2 / in2),
                      std::numbers::sqrt2 / 2.0, 0.005);
    }
  }
}

TEST(Imu, SaturatesAtItsRange) {
  ImuConfig c = no_noise();
  Imu imu(c, 0.002, 1);
  imu.observe({100.0, -100.0, 0.0}, {0.0, 500.0, 0.0});
  const ImuReading r = imu.read();
  EXPECT_DOUBLE_EQ(r.w_WB_B_meas.x(), c.gyro_range_radps);
  EXPECT_DOUBLE_EQ(r.w_WB_B_meas.y(), -c.gyro_range_radps);
  EXPECT_DOUBLE_EQ(r.specific_force_B_meas.y(), c.accelerometer_range_mps2);
}

TEST(Imu, RefusesInvalidConfigs) {
  ImuConfig c;
  c.rate_hz = 300.0;
  EXPECT_THAT([&] { Imu(c, 0.002, 1); }, ThrowsMessage<std::invalid_argument>(HasSubstr("imu.rate: ")));
  c = {};
  c.cutoff_hz = 250.0;
  EXPECT_THAT([&] { Imu(c, 0.002, 1); }, ThrowsMessage<std::invalid_argument>(HasSubstr("imu.cutoff: ")));
  c = {};
  c.gyro_noise_density = std::nan("");
  EXPECT_THAT([&] { Imu(c, 0.002, 1); }, ThrowsMessage<std::invalid_argument>(HasSubstr("imu.gyro_noise: ")));
}

}  // namespace
}  // namespace hedgehop::dynamics::sensors
