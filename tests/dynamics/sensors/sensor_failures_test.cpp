#include "dynamics/sensors/sensor_errors.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hedgehop::dynamics::sensors {
namespace {

using Mode = SensorFailure::Mode;

constexpr int64_t kMs = 1'000'000;

SensorFailures failing(Mode mode, double value = 0.0, int axis = 0) {
  return SensorFailures({{Instrument::gps, mode, 100 * kMs, 200 * kMs, value, axis, 7}});
}
Eigen::Vector3d reading(int64_t t_ms) { return {static_cast<double>(t_ms), -1.0, 2.0}; }

TEST(SensorFailures, DoNotChangeOtherTimesOrInstruments) {
  for (const Mode mode : {Mode::off, Mode::stuck, Mode::bias, Mode::noise}) {
    SensorFailures failures = failing(mode, 3.0);
    for (const int64_t t_ms : {0, 99, 200, 500}) {
      EXPECT_EQ(failures.deliver(Instrument::gps, t_ms * kMs, reading(t_ms)), reading(t_ms));
    }
    EXPECT_EQ(failures.deliver(Instrument::gyros, 600 * kMs, reading(600)), reading(600));
  }
}

TEST(SensorFailures, OffDeliversNoReadingAndStuckTheLastOne) {
  SensorFailures off = failing(Mode::off), stuck = failing(Mode::stuck);
  EXPECT_EQ(stuck.deliver(Instrument::gps, 100 * kMs, reading(100)), std::nullopt);  // no previous reading
  for (const int64_t t_ms : {0, 50}) stuck.deliver(Instrument::gps, t_ms * kMs, reading(t_ms));
  for (const int64_t t_ms : {100, 150, 199}) {
    EXPECT_EQ(off.deliver(Instrument::gps, t_ms * kMs, reading(t_ms)), std::nullopt);
    EXPECT_EQ(stuck.deliver(Instrument::gps, t_ms * kMs, reading(t_ms)), reading(50));
  }
}

TEST(SensorFailures, BiasIsAddedToOneComponent) {
  SensorFailures bias = failing(Mode::bias, 2.5, 1);
  EXPECT_EQ(bias.deliver(Instrument::gps, 150 * kMs, reading(150)), Eigen::Vector3d(150.0, 1.5, 2.0));
  SensorFailures height({{Instrument::height_sensor, Mode::bias, 0, kMs, -0.5, 0, 1}});
  EXPECT_EQ(height.deliver(Instrument::height_sensor, 0, std::optional(4.0)), 3.5);
  EXPECT_EQ(height.deliver(Instrument::height_sensor, 0, std::optional<double>()), std::nullopt);
}

TEST(SensorFailures, NoiseHasItsSigmaAndItsOwnSeed) {
  constexpr int kCount = 20000;
  SensorFailures a({{Instrument::gyros, Mode::noise, 0, kCount, 0.2, 0, 7}}), same = a;
  SensorFailures other({{Instrument::gyros, Mode::noise, 0, kCount, 0.2, 0, 8}});
  double squares = 0.0;
  for (int64_t t = 0; t < kCount; ++t) {
    const auto delivered = a.deliver(Instrument::gyros, t, Eigen::Vector3d(1.0, 2.0, 3.0));
    EXPECT_EQ(delivered, same.deliver(Instrument::gyros, t, Eigen::Vector3d(1.0, 2.0, 3.0)));
    EXPECT_NE(delivered, other.deliver(Instrument::gyros, t, Eigen::Vector3d(1.0, 2.0, 3.0)));
    squares += (*delivered - Eigen::Vector3d(1.0, 2.0, 3.0)).squaredNorm();
  }
  constexpr double kFiveSigma = 5.0 * 0.2 / 346.0;  // of a standard deviation from 60,000 numbers: sigma / sqrt(2 n)
  EXPECT_NEAR(std::sqrt(squares / (3.0 * kCount)), 0.2, kFiveSigma);
}

}  // namespace
}  // namespace hedgehop::dynamics::sensors
