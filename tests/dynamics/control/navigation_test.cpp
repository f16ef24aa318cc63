#include "dynamics/control/navigation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/dynamics/control/closed_loop.h"

namespace hedgehop::dynamics::control {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;
// The alignment on the ground has a tilt error by the accelerometer bias, 0.02 g or 1.2 deg per axis, and a heading
// error by the compass offset, 1 deg. A filter that does not estimate these in flight would keep an error of 2 deg.
constexpr double kAlignedRad = 1.5 * kDeg;

struct Errors {
  double attitude_rms_rad = 0.0, velocity_rms_mps = 0.0, position_rms_m = 0.0, altitude_max_m = 0.0;
  double within_3_sigma = 0.0;     ///< share of attitude, velocity and position components
  double mean_square_ratio = 0.0;  ///< of errors to their sigmas, 1 for correct sigmas
};

Errors errors(const std::vector<std::vector<Sample>>& flights) {
  Errors e;
  double samples = 0.0, components = 0.0;
  const auto judge = [&](const Eigen::Vector3d& error, const Eigen::Vector3d& sigma) {
    for (int i = 0; i < 3; ++i) {
      const double ratio = std::abs(error[i]) / sigma[i];
      e.within_3_sigma += ratio <= 3.0 ? 1.0 : 0.0;
      e.mean_square_ratio += ratio * ratio;
      components += 1.0;
    }
  };
  for (const std::vector<Sample>& flight : flights) {
    for (const Sample& s : flight) {
      if (s.t_s < kSettledS) continue;
      const Eigen::Vector3d attitude = s.attitude_error(), velocity = s.v_WB_W_est() - s.v_WB_W();
      const Eigen::Vector3d position = s.estimate.p_WB_est - s.body.p_WB;
      judge(attitude, s.estimate.sigma_attitude_B_rad);
      judge(velocity, s.estimate.sigma_v_W_mps);
      judge(position, s.estimate.sigma_p_W_m);
      e.attitude_rms_rad += attitude.squaredNorm();
      e.velocity_rms_mps += velocity.squaredNorm();
      e.position_rms_m += position.squaredNorm();
      e.altitude_max_m = std::max(e.altitude_max_m, std::abs(position.z()));
      samples += 1.0;
    }
  }
  e.attitude_rms_rad = std::sqrt(e.attitude_rms_rad / samples);
  e.velocity_rms_mps = std::sqrt(e.velocity_rms_mps / samples);
  e.position_rms_m = std::sqrt(e.position_rms_m / samples);
  e.within_3_sigma /= components;
  e.mean_square_ratio /= components;
  return e;
}

TEST(Navigation, ErrorsAreSmallAndMatchTheirSigmasInAcceleratedFlight) {
  const Errors e = errors(flights({}, 12, 40.0, square));
  RecordProperty("attitude_rms_deg", std::to_string(e.attitude_rms_rad / kDeg));
  RecordProperty("velocity_rms_mps", std::to_string(e.velocity_rms_mps));
  RecordProperty("within_3_sigma", std::to_string(e.within_3_sigma));
  RecordProperty("mean_square_ratio", std::to_string(e.mean_square_ratio));
  EXPECT_LT(e.attitude_rms_rad, kAlignedRad);
  EXPECT_LT(e.velocity_rms_mps, 0.05);
  EXPECT_GT(e.within_3_sigma, 0.98);
  EXPECT_GT(e.mean_square_ratio, 0.6);  // the sigmas are not too large
  EXPECT_LT(e.mean_square_ratio, 1.6);
}

TEST(Navigation, ErrorsMatchTheirSigmasInTurbulence) {
  Loop loop;
  loop.weather = air::WindConfig{.speed_mps = 5.0, .from_rad = 1.0, .turbulence_w20_mps = 7.7};
  const Errors e = errors(flights(loop, 6, 40.0, square));
  EXPECT_LT(e.attitude_rms_rad, kAlignedRad);
  EXPECT_LT(e.velocity_rms_mps, 0.05);
  EXPECT_GT(e.within_3_sigma, 0.98);
}

TEST(Navigation, KeepsLevelByFlowAloneWithoutReception) {
  Loop loop;
  loop.avionics.gps.enabled = false;
  const Errors e = errors(flights(loop, 4, 60.0, square));
  EXPECT_LT(e.attitude_rms_rad, kAlignedRad);
  EXPECT_LT(e.velocity_rms_mps, 0.06);
  EXPECT_LT(e.position_rms_m, 1.5);  // dead reckoning
}

TEST(Navigation, SatelliteVelocitiesSufficeWithoutTexture) {
  Loop loop;
  loop.flow_sigma = 0.0;
  const Errors e = errors(flights(loop, 4, 60.0, square));
  EXPECT_LT(e.attitude_rms_rad, 1.5 * kDeg);
  EXPECT_LT(e.velocity_rms_mps, 0.15);
}

TEST(Navigation, AttitudeSurvivesTwoMinutesOnInertialSensorsAlone) {
  Loop loop;
  loop.flow_sigma = 0.0;
  loop.avionics.gps.enabled = false;
  for (const std::vector<Sample>& flight : flights(loop, 3, 120.0, square)) {
    EXPECT_LT(flight.back().attitude_error().head<2>().norm(), 3.0 * kDeg);
  }
}

/// Alignment by readings without errors, with heading 0.
Alignment level_alignment() {
  GroundAlignment ground({}, {});
  constexpr int kReadings = 3000;  // 30 s
  for (int i = 0; i < kReadings; ++i) ground.add({Eigen::Vector3d::Zero(), {0.0, 0.0, -kGravityMps2}});
  ground.add_heading(0.0);
  return ground.result(0.0, 1.0);
}

TEST(Navigation, FlowOutliersHaveLittleEffect) {
  const Navigation::Sensors sensors;
  Navigation navigation({}, sensors);
  navigation.reset(level_alignment(), Eigen::Vector3d::Zero());
  const sensors::ImuReading hover{Eigen::Vector3d::Zero(), {0.0, 0.0, -kGravityMps2}};
  for (int i = 0; i < 200; ++i) {
    navigation.predict(hover);
    if (i % 2 == 0) navigation.correct_velocity(Eigen::Vector2d::Zero(), 0.1);
  }
  navigation.correct_velocity({5.0, 0.0}, 0.1);
  EXPECT_LT(navigation.estimate().v_WB_B_est.norm(), 0.03);
  // Many agreeing readings are accepted.
  for (int i = 0; i < 500; ++i) {
    navigation.predict(hover);
    navigation.correct_velocity({1.0, 0.0}, 0.1);
  }
  EXPECT_NEAR(navigation.estimate().v_WB_B_est.x(), 1.0, 0.2);
}

TEST(Navigation, AltitudeHoldsThroughLostReadings) {
  Loop loop;
  loop.avionics.height_sensor.ranger.dropout = 0.9;
  const Errors e = errors(flights(loop, 3, 40.0, square));
  EXPECT_LT(e.altitude_max_m, 0.4);
}

/// Squares of errors over their sigmas at one instant, summed over axes and flights: chi-square distributed.
struct ChiSquares {
  double attitude = 0.0, velocity = 0.0, horizontal = 0.0, altitude = 0.0;

  void add(const Sample& s) {
    const auto square_ratio = [](const auto& error, const auto& sigma) {
      return error.cwiseQuotient(sigma).squaredNorm();
    };
    const Eigen::Vector3d position = s.estimate.p_WB_est - s.body.p_WB;
    attitude += square_ratio(s.attitude_error(), s.estimate.sigma_attitude_B_rad);
    velocity += square_ratio(Eigen::Vector3d(s.v_WB_W_est() - s.v_WB_W()), s.estimate.sigma_v_W_mps);
    horizontal += square_ratio(Eigen::Vector2d(position.head<2>()), Eigen::Vector2d(s.estimate.sigma_p_W_m.head<2>()));
    altitude += std::pow(position.z() / s.estimate.sigma_p_W_m.z(), 2);
  }
};

// Bounds: chi-square, 0.05 and 99.95 %, of 36, 24 and 12 degrees of freedom.
TEST(Navigation, ErrorsMatchTheirSigmasForFiveMinutesOnTheBarometer) {
  Loop loop;
  loop.vehicle = multicopter::MulticopterConfig();
  loop.avionics.height_sensor.ranger.max_m = 5.0;  // the flight is at 10 m
  loop.avionics.barometer.enabled = true;
  constexpr int kFlights = 12;
  std::array<ChiSquares, 3> at_100_200_300_s;
  for (int i = 0; i < kFlights; ++i) {
    loop.seed = static_cast<uint64_t>(i) + 1;
    const std::vector<Sample> flight = fly(loop, 300.01, square);
    for (size_t k = 0; k < 3; ++k) at_100_200_300_s[k].add(flight[(k + 1) * 10000]);
  }
  for (size_t k = 0; k < 3; ++k) {
    const ChiSquares& chi = at_100_200_300_s[k];
    const auto expect_within = [k](const std::string& what, double value, double least, double most) {
      RecordProperty(what + "_" + std::to_string(k + 1) + "00_s", std::to_string(value));
      EXPECT_GT(value, least) << what;
      EXPECT_LT(value, most) << what;
    };
    expect_within("attitude", chi.attitude, 14.40, 70.59);
    expect_within("velocity", chi.velocity, 14.40, 70.59);
    expect_within("horizontal", chi.horizontal, 7.45, 53.48);
    expect_within("altitude", chi.altitude, 1.93, 34.82);
  }
}

TEST(Navigation, CorrectionsDoNotRotateTheGyroAttitude) {
  Navigation filter({}, {});
  const Eigen::Quaterniond q_WB(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()));
  filter.reset(level_alignment().rotated(q_WB), Eigen::Vector3d::Zero());
  const Eigen::Vector3d w(0.2, -0.1, 0.4);
  constexpr int kReadings = 101;  // 1 s at 100 Hz; the first one only starts the integration
  for (int i = 0; i < kReadings; ++i) {
    filter.predict({w, Eigen::Vector3d(0.0, 0.0, -9.80665)});
    filter.correct_velocity({0.5, -0.5}, 0.05);
    filter.correct_heading(1.0);
  }
  const NavigationEstimate& estimate = filter.estimate();
  const Eigen::Vector3d bias = w - estimate.w_WB_B_est;  // the error of the estimate in flight is part of the rotation
  const Eigen::Quaterniond rotated = q_WB * Eigen::AngleAxisd(w.norm(), w.normalized());
  EXPECT_LT(estimate.q_WB_gyro.angularDistance(rotated), bias.norm() + 1e-9);
  EXPECT_GT(estimate.q_WB_est.angularDistance(rotated), 5.0 * estimate.q_WB_gyro.angularDistance(rotated));
}

/// Gives the sensors of a subset one standard deviation for all errors, in SI units.
AvionicsConfig with_sensors_of(unsigned subset, double sigma) {
  AvionicsConfig c;
  c.barometer.enabled = true;
  if (subset & 1u) {
    for (double* const error : {&c.imu.gyro_noise_density, &c.imu.gyro_bias_walk, &c.imu.gyro_offset_radps,
                                &c.imu.accelerometer_noise_density, &c.imu.accelerometer_bias_walk,
                                &c.imu.accelerometer_offset_mps2, &c.imu.misalignment_rad}) {
      *error = sigma;
    }
  }
  if (subset & 2u) c.magnetometer.noise_rad = c.magnetometer.offset_rad = sigma;
  if (subset & 4u) {
    c.gps.noise_m = c.gps.velocity_noise_mps = c.gps.wander_horizontal_m = c.gps.wander_vertical_m = sigma;
  }
  if (subset & 8u) {
    sensors::RangerConfig& ranger = c.height_sensor.ranger;
    ranger.noise_m = ranger.noise_per_range = ranger.offset_m = ranger.dropout = sigma;
  }
  if (subset & 16u) c.barometer.noise_pa = c.barometer.wander_pa = sigma;
  return c;
}

TEST(Navigation, EverySubsetOfExactSensorsFliesLikeANoiseOf1em8) {
  constexpr double kApartM = 1e-3;  // closed loops keep the effect of a noise of 1e-8 below this
  for (unsigned subset = 1; subset < 32; ++subset) {
    Loop exact, noisy;
    exact.vehicle = noisy.vehicle = multicopter::MulticopterConfig();
    exact.avionics = with_sensors_of(subset, 0.0);
    noisy.avionics = with_sensors_of(subset, 1e-8);
    exact.flow_sigma = noisy.flow_sigma = subset % 2 == 0 ? 0.1 : 0.0;
    const auto by_exact = flights(exact, 10, 8.0, square), by_noisy = flights(noisy, 10, 8.0, square);
    for (size_t seed = 0; seed < by_exact.size(); ++seed) {
      const Sample &a = by_exact[seed].back(), &b = by_noisy[seed].back();
      EXPECT_LT((a.body.p_WB - b.body.p_WB).norm(), kApartM) << "subset " << subset << " seed " << seed;
      EXPECT_NEAR(a.body.p_WB.z(), -10.0, 3.0) << "subset " << subset << " seed " << seed;
    }
  }
}

TEST(Navigation, EstimatesTheGyroBias) {
  Navigation filter({}, {});
  Alignment rough = level_alignment();
  rough.gyro_bias_sigma_radps = 0.01;
  filter.reset(rough, Eigen::Vector3d::Zero());
  const Eigen::Vector3d bias(0.01, -0.006, 0.008);
  for (int i = 0; i < 4000; ++i) {  // 40 s
    filter.predict({bias, {0.0, 0.0, -kGravityMps2}});
    if (i % 2 == 0) filter.correct_velocity(Eigen::Vector2d::Zero(), 0.1);
    if (i % 2 == 0) filter.correct_heading(0.0);
  }
  EXPECT_LT(filter.estimate().w_WB_B_est.norm(), 0.1 * bias.norm());
}

}  // namespace
}  // namespace hedgehop::dynamics::control
