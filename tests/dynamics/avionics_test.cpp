#include "dynamics/avionics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "tests/dynamics/control/closed_loop.h"

namespace hedgehop::dynamics {
namespace {

control::Setpoint away(double t_s) { return control::VelocitySetpoint{{t_s < 3.0 ? 2.0 : -1.0, 1.0}, 11.0, 0.3}; }

bool same(const Sample& a, const Sample& b) {
  return a.controls == b.controls && a.body.p_WB == b.body.p_WB && a.body.q_WB.coeffs() == b.body.q_WB.coeffs() &&
         a.estimate.p_WB_est == b.estimate.p_WB_est && a.estimate.v_WB_B_est == b.estimate.v_WB_B_est;
}

TEST(Avionics, EqualSeedsGiveEqualFlightsBitForBit) {
  Loop loop;
  loop.weather = air::WindConfig{.speed_mps = 3.0, .turbulence_w20_mps = 7.7};
  const std::vector<Sample> a = fly(loop, 6.0, away), b = fly(loop, 6.0, away);
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) ASSERT_TRUE(same(a[i], b[i])) << i;
  loop.seed = 2;
  EXPECT_FALSE(same(fly(loop, 6.0, away).back(), a.back()));
}

/// Runs two avionics in the same hover and compares their final estimates.
control::NavigationEstimate after_hover(Avionics& avionics, double duration_s = 3.0) {
  Vehicle vehicle{VehicleConfig(helicopter::HelicopterConfig())};
  vehicle.reset({0.0, 0.0, -10.0}, 0.0, Eigen::Vector3d::Zero());
  const SensedTruth truth{vehicle.body(), vehicle.specific_force_B(), 10.0};
  avionics.reset(truth);
  for (int64_t tick = 0; tick < static_cast<int64_t>(duration_s * 500.0); ++tick)
    avionics.sense(tick * 2'000'000, truth);
  return avionics.navigation();
}

bool same(const control::NavigationEstimate& a, const control::NavigationEstimate& b) {
  return a.p_WB_est == b.p_WB_est && a.q_WB_est.coeffs() == b.q_WB_est.coeffs() && a.v_WB_B_est == b.v_WB_B_est &&
         a.w_WB_B_est == b.w_WB_B_est;
}

TEST(Avionics, ResetEqualsNew) {
  const auto make = [] {
    return Avionics({}, helicopter::HelicopterConfig(), 0.002, [](std::string_view n) { return stream_seed(1, n); });
  };
  Avionics used = make(), fresh = make();
  after_hover(used);
  for (int i = 0; i < 10; ++i) used.control(control::VelocitySetpoint{{3.0, 0.0}, 20.0, 1.0}, 0.01);
  EXPECT_TRUE(same(after_hover(used), after_hover(fresh)));
  const control::Setpoint s = control::VelocitySetpoint{{1.0, 0.0}, 10.0, 0.0};
  const Controls a = used.control(s, 0.01), b = fresh.control(s, 0.01);
  EXPECT_EQ(a, b);
}

TEST(Avionics, EachNoiseSourceHasItsOwnStream) {
  std::vector<std::string> names;
  Avionics avionics({}, helicopter::HelicopterConfig(), 0.002, [&](std::string_view n) {
    names.emplace_back(n);
    return stream_seed(1, n);
  });
  EXPECT_THAT(names, testing::UnorderedElementsAre("imu", "gps", "height_sensor", "magnetometer", "survey"));

  // Another seed of one stream changes the estimate through that sensor only.
  const auto estimated = [](AvionicsConfig c, std::string_view other) {
    Avionics a(c, helicopter::HelicopterConfig(), 0.002,
               [&](std::string_view n) { return stream_seed(n == other ? 2 : 1, n); });
    return after_hover(a);
  };
  AvionicsConfig all;
  AvionicsConfig blind;
  blind.gps.enabled = blind.magnetometer.enabled = blind.height_sensor.ranger.enabled = false;
  for (const std::string_view name : {"gps", "height_sensor", "magnetometer"}) {
    EXPECT_FALSE(same(estimated(all, name), estimated(all, "none"))) << name;
    EXPECT_TRUE(same(estimated(blind, name), estimated(blind, "none"))) << name;
  }
  EXPECT_FALSE(same(estimated(blind, "imu"), estimated(blind, "none")));

  // Sensors that are not on board have no stream.
  AvionicsConfig with_options;
  with_options.barometer.enabled = with_options.range_finder.ranger.enabled = true;
  names.clear();
  Avionics(with_options, helicopter::HelicopterConfig(), 0.002, [&](std::string_view n) {
    names.emplace_back(n);
    return stream_seed(1, n);
  });
  EXPECT_THAT(names, testing::UnorderedElementsAre("imu", "gps", "height_sensor", "magnetometer", "survey", "barometer",
                                                   "range_finder"));
  EXPECT_FALSE(same(estimated(with_options, "barometer"), estimated(with_options, "none")));
  EXPECT_TRUE(same(estimated(with_options, "range_finder"), estimated(with_options, "none")));
}

TEST(Avionics, MeasuresTheRangeAlongTheBeamFromItsMountingPosition) {
  AvionicsConfig c;
  c.range_finder = {.ranger = {.noise_m = 0.0, .noise_per_range = 0.0, .dropout = 0.0, .latency_s = 0.0},
                    .direction_B = {0.0, 2.0, 0.0},
                    .p_BI_m = {0.5, 0.0, 0.1}};
  Avionics avionics(c, helicopter::HelicopterConfig(), 0.002, [](std::string_view n) { return stream_seed(1, n); });
  // Heading east, banked to the right by 30 degrees: a beam to the right points south and down.
  SensedTruth truth;
  truth.body.p_WB = {3.0, 4.0, -10.0};
  truth.body.q_WB = Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()) *
                    Eigen::AngleAxisd(std::numbers::pi / 6, Eigen::Vector3d::UnitX());
  int casts = 0;
  truth.beam_distance = [&](const Eigen::Vector3d& p_W, const Eigen::Vector3d& direction_W, double reach_m) {
    ++casts;
    EXPECT_NEAR((direction_W - Eigen::Vector3d(-std::sqrt(0.75), 0.0, 0.5)).norm(), 0.0, 1e-12);
    EXPECT_NEAR((p_W - Eigen::Vector3d(3.05, 4.5, -10.0 + 0.1 * std::sqrt(0.75))).norm(), 0.0, 1e-12);
    EXPECT_EQ(reach_m, c.range_finder.ranger.max_m);
    return 7.5;
  };
  avionics.reset(truth);
  EXPECT_FALSE(avionics.range_m());
  for (int64_t tick = 0; tick < 100; ++tick) avionics.sense(tick * 2'000'000, truth);
  EXPECT_EQ(casts, 10) << "one per reading, 50 per second";
  EXPECT_EQ(avionics.range_m(), 7.5);
  avionics.reset(truth);
  EXPECT_FALSE(avionics.range_m());
}

TEST(Avionics, FliesAtOtherPhysicsAndSensorRates) {
  Loop loop;
  loop.physics_rate_hz = 1000.0;
  loop.avionics.imu.rate_hz = 250.0;
  loop.avionics.height_sensor.ranger.rate_hz = 20.0;
  loop.avionics.magnetometer.rate_hz = 10.0;
  const std::vector<Sample> flight = fly(loop, 10.0, away);
  EXPECT_LT((flight.back().v_WB_W() - Eigen::Vector3d(-1.0, 1.0, 0.0)).norm(), 0.2);
  EXPECT_NEAR(flight.back().body.p_WB.z(), -11.0, 0.2);
}

TEST(Avionics, NamesTheRateThatDoesNotDivideThePhysicsRate) {
  AvionicsConfig c;
  c.magnetometer.rate_hz = 30.0;
  EXPECT_THAT([&] { Avionics(c, helicopter::HelicopterConfig(), 0.002, [](std::string_view) { return uint64_t{1}; }); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("magnetometer.rate: ")));
}

}  // namespace
}  // namespace hedgehop::dynamics
