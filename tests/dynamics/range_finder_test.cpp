#include "dynamics/range_finder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

namespace hedgehop::dynamics {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

RangeFinderConfig exact() {
  RangeFinderConfig c;
  c.enabled = true;
  c.noise_m = c.noise_per_range = c.dropout = c.latency_s = 0.0;
  return c;
}

TEST(RangeFinder, NoiseGrowsWithTheRange) {
  RangeFinderConfig c;
  c.enabled = true;
  c.dropout = c.latency_s = 0.0;
  RangeFinder sensor(c, 0.002, 5);
  constexpr int kCount = 20000;
  for (const auto& [range_m, sigma_m] :
       {std::pair{2.0, std::hypot(0.01, 0.01)}, std::pair{30.0, std::hypot(0.01, 0.15)}}) {
    double sum = 0.0, sum2 = 0.0;
    for (int i = 0; i < kCount; ++i) {
      sensor.feel(range_m);
      const double error = *sensor.read() - range_m;
      sum += error, sum2 += error * error;
    }
    EXPECT_NEAR(sum / kCount, 0.0, 4.0 * sigma_m / std::sqrt(kCount));
    EXPECT_NEAR(std::sqrt(sum2 / kCount), sigma_m, 0.03 * sigma_m);
  }
}

TEST(RangeFinder, LosesItsShareOfReadingsWithoutDisturbingTheOthers) {
  RangeFinderConfig sure, unsure;
  sure.enabled = unsure.enabled = true;
  sure.latency_s = unsure.latency_s = sure.dropout = 0.0;
  unsure.dropout = 0.2;
  RangeFinder a(sure, 0.002, 5), b(unsure, 0.002, 5);
  constexpr int kCount = 20000;
  int lost = 0;
  for (int i = 0; i < kCount; ++i) {
    a.feel(10.0), b.feel(10.0);
    const double reading = *a.read();
    const std::optional<double> same = b.read();
    if (same) {
      ASSERT_EQ(*same, reading);
    } else {
      ++lost;
    }
  }
  EXPECT_NEAR(static_cast<double>(lost) / kCount, 0.2, 0.012);
}

// Check AS6.
TEST(RangeFinder, AS6_ReadingsOfAWallThatNearsAreALatencyOld) {
  RangeFinderConfig c = exact();
  c.latency_s = 0.1;
  constexpr double kDt = 0.002, kSpeed = 4.0;
  RangeFinder sensor(c, kDt, 1);
  for (int64_t tick = 0; tick < 1000; ++tick) {
    const double distance_m = 30.0 - kSpeed * kDt * static_cast<double>(tick);
    sensor.feel(distance_m);
    if (tick % sensor.period() != 0) continue;
    const std::optional<double> reading = sensor.read();
    ASSERT_EQ(reading.has_value(), tick >= 50) << tick;
    if (reading) {
      EXPECT_NEAR(*reading - distance_m, 0.40, 1e-9);
    }
  }
}

TEST(RangeFinder, IsBlindOutOfRangeAndWhenOff) {
  const auto read = [](RangeFinder sensor, double distance_m) {
    sensor.feel(distance_m);
    return sensor.read();
  };
  const RangeFinder on(exact(), 0.002, 1), off({}, 0.002, 1);
  EXPECT_FALSE(read(on, 0.09).has_value());
  EXPECT_TRUE(read(on, 0.11).has_value());
  EXPECT_TRUE(read(on, 39.9).has_value());
  EXPECT_FALSE(read(on, 40.1).has_value());
  EXPECT_FALSE(read(on, std::numeric_limits<double>::infinity()).has_value());
  EXPECT_FALSE(read(on, std::nan("")).has_value());
  EXPECT_FALSE(read(off, 10.0).has_value());
}

TEST(RangeFinder, RefusesWhatCannotBe) {
  RangeFinderConfig c;
  c.direction_B.setZero();
  EXPECT_THAT([&] { RangeFinder(c, 0.002, 1); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("range_finder.direction: ")));
  c.direction_B = {0.0, 3.0, 4.0};
  EXPECT_NEAR((RangeFinder(c, 0.002, 1).direction_B() - Eigen::Vector3d{0.0, 0.6, 0.8}).norm(), 0.0, 1e-15);
  c.max_m = c.min_m;
  EXPECT_THAT([&] { RangeFinder(c, 0.002, 1); }, ThrowsMessage<std::invalid_argument>(HasSubstr("range_finder.max: ")));
}

}  // namespace
}  // namespace hedgehop::dynamics
