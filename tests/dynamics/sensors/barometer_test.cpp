#include "dynamics/sensors/barometer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <stdexcept>

namespace hedgehop::dynamics::sensors {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kSeaLevelPa = 101325.0;

std::optional<double> at(Barometer& barometer, double altitude_m) {
  barometer.observe(altitude_m);
  return barometer.read();
}

TEST(Barometer, WithoutErrorsReadsTheStandardAtmosphere) {
  BarometerConfig c;
  c.noise_pa = c.wander_pa = c.lag_s = 0.0;
  Barometer barometer(c, 0.002, 1);
  EXPECT_EQ(barometer.period(), 10);
  EXPECT_NEAR(*at(barometer, 0.0), kSeaLevelPa, 1e-9);
  EXPECT_NEAR(*at(barometer, 500.0), 95461.29, 1e-5 * 95461.29);  // [ISA1976] eq. (33a)
}

TEST(Barometer, WhiteNoiseIsOnePascal) {
  BarometerConfig c;
  c.wander_pa = 0.0;
  Barometer barometer(c, 0.002, 3);
  constexpr int kCount = 20000;
  double sum = 0.0, sum2 = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double error = *at(barometer, 0.0) - kSeaLevelPa;
    sum += error, sum2 += error * error;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 4.0 / std::sqrt(kCount));
  EXPECT_NEAR(std::sqrt(sum2 / kCount), 1.0, 0.03);
}

TEST(Barometer, SlowErrorHasItsSigmaAndCorrelationTime) {
  BarometerConfig c;
  c.noise_pa = 0.0;
  c.wander_time_s = 4.0;                        // short, so that the decay is visible
  constexpr int kFlights = 3000, kLater = 100;  // 2 s at 50 Hz
  double first2 = 0.0, last2 = 0.0, product = 0.0;
  for (int i = 0; i < kFlights; ++i) {
    Barometer barometer(c, 0.02, static_cast<uint64_t>(i));
    const double first = *at(barometer, 0.0) - kSeaLevelPa;
    for (int k = 1; k < kLater; ++k) at(barometer, 0.0);
    const double last = *at(barometer, 0.0) - kSeaLevelPa;
    first2 += first * first, last2 += last * last, product += first * last;
  }
  EXPECT_NEAR(std::sqrt(first2 / kFlights), 12.0, 0.05 * 12.0);
  EXPECT_NEAR(std::sqrt(last2 / kFlights), 12.0, 0.05 * 12.0);
  EXPECT_NEAR(product / kFlights, 144.0 * std::exp(-0.5), 0.08 * 144.0);
}

TEST(Barometer, LagsAClimbByItsTimeConstant) {
  BarometerConfig c;
  c.noise_pa = c.wander_pa = 0.0;
  c.lag_s = 0.1;
  Barometer late(c, 0.002, 1);
  c.lag_s = 0.0;
  Barometer prompt(c, 0.002, 1);
  constexpr double kClimbMps = 2.0;
  double late_pa = 0.0;
  for (int tick = 0; tick <= 500; ++tick) {
    late.observe(kClimbMps * 0.002 * tick);
    late_pa = *late.read();
  }
  // A first-order lag delays a ramp by the time constant; sampled, by up to half a tick more or less.
  EXPECT_NEAR(late_pa, *at(prompt, kClimbMps * (1.0 - 0.1)), 12.0 * kClimbMps * 0.0011);
  EXPECT_GT(std::abs(late_pa - *at(prompt, kClimbMps)), 12.0 * kClimbMps * 0.09);
}

TEST(Barometer, DropsTheConfiguredShareOfReadings) {
  BarometerConfig c;
  c.dropout = 0.2;
  Barometer barometer(c, 0.002, 4);
  constexpr int kCount = 20000;
  int lost = 0;
  for (int i = 0; i < kCount; ++i) lost += at(barometer, 10.0) ? 0 : 1;
  EXPECT_NEAR(static_cast<double>(lost) / kCount, 0.2, 0.012);
}

TEST(Barometer, RefusesInvalidConfigs) {
  BarometerConfig c;
  c.rate_hz = 30.0;
  EXPECT_THAT([&] { Barometer(c, 0.002, 1); }, ThrowsMessage<std::invalid_argument>(HasSubstr("barometer.rate: ")));
  c = {};
  c.wander_time_s = 0.0;
  EXPECT_THAT([&] { Barometer(c, 0.002, 1); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("barometer.wander_time: ")));
}

}  // namespace
}  // namespace hedgehop::dynamics::sensors
