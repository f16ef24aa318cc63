#include "dynamics/sensors/gps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "tests/dynamics/recorded_check.h"

namespace hedgehop::dynamics::sensors {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

GpsConfig exact_gps() {
  GpsConfig c;
  c.wander_horizontal_m = c.wander_vertical_m = c.noise_m = c.velocity_noise_mps = 0.0;
  return c;
}

// Check AS6.
TEST(Gps, AS6_FixesAreDelayedByTheLatency) {
  constexpr double kDt = 0.002, kSpeed = 5.0;
  Gps gps(exact_gps(), kDt, 1);
  EXPECT_EQ(gps.period(), 100);
  int fixes = 0;
  for (int64_t tick = 0; tick < 1000; ++tick) {
    const double t = static_cast<double>(tick) * kDt;
    gps.observe({kSpeed * t, 0.0, -10.0}, {kSpeed, 0.0, 0.0});
    if (tick % gps.period() != 0) continue;
    const std::optional<GpsFix> fix = gps.read();
    EXPECT_EQ(fix.has_value(), tick > 0);  // the first fix would be from before the flight
    if (!fix) continue;
    ++fixes;
    expect_recorded("lag of the position at 5 m/s, m", kSpeed * t - fix->p_WB_W_meas.x(), 0.60, 1e-9);
    EXPECT_DOUBLE_EQ(fix->v_WB_W_meas.x(), kSpeed);
  }
  EXPECT_EQ(fixes, 9);
}

TEST(Gps, ErrorsHaveTheirSigmaAndCorrelation) {
  GpsConfig c;
  c.latency_s = 0.0;
  constexpr int kFlights = 3000;
  constexpr int kLater = 150;  // readings: 30 s, half the correlation time
  double wander2 = 0.0, product = 0.0, vertical2 = 0.0, velocity2 = 0.0;
  for (int i = 0; i < kFlights; ++i) {
    Gps gps(c, 0.2, static_cast<uint64_t>(i));
    gps.observe(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
    const GpsFix first = *gps.read();
    for (int k = 1; k < kLater; ++k) gps.read();
    const GpsFix last = *gps.read();
    wander2 += first.p_WB_W_meas.head<2>().squaredNorm();
    product += first.p_WB_W_meas.head<2>().dot(last.p_WB_W_meas.head<2>());
    vertical2 += first.p_WB_W_meas.z() * first.p_WB_W_meas.z();
    velocity2 += first.v_WB_W_meas.squaredNorm();
  }
  const double variance = 1.5 * 1.5 + 0.2 * 0.2;
  EXPECT_NEAR(wander2 / (2 * kFlights), variance, 0.06 * variance);
  EXPECT_NEAR(product / (2 * kFlights), 1.5 * 1.5 * std::exp(-0.5), 0.06 * variance);
  EXPECT_NEAR(vertical2 / kFlights, 2.5 * 2.5 + 0.04, 0.08 * 6.29);
  EXPECT_NEAR(std::sqrt(velocity2 / (3 * kFlights)), 0.1, 0.003);
}

TEST(Gps, HasNoFixWithoutReception) {
  GpsConfig c;
  c.enabled = false;
  Gps gps(c, 0.2, 1);
  for (int i = 0; i < 10; ++i) {
    gps.observe(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
    EXPECT_FALSE(gps.read().has_value());
  }
}

TEST(Gps, DropsTheConfiguredShareOfFixes) {
  GpsConfig c = exact_gps();
  c.latency_s = 0.0;
  c.dropout = 0.3;
  Gps gps(c, 0.2, 1);
  constexpr int kCount = 20000;
  int lost = 0;
  for (int i = 0; i < kCount; ++i) {
    gps.observe(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
    if (!gps.read()) ++lost;
  }
  EXPECT_NEAR(static_cast<double>(lost) / kCount, 0.3, 0.013);  // four standard errors
}

TEST(Gps, RefusesInvalidConfigs) {
  GpsConfig c;
  c.rate_hz = 7.0;
  EXPECT_THAT([&] { Gps(c, 0.002, 1); }, ThrowsMessage<std::invalid_argument>(HasSubstr("gps.rate: ")));
  c = {};
  c.wander_time_s = 0.0;
  EXPECT_THAT([&] { Gps(c, 0.002, 1); }, ThrowsMessage<std::invalid_argument>(HasSubstr("gps.wander_time: ")));
}

}  // namespace
}  // namespace hedgehop::dynamics::sensors
