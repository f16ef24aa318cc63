#include "dynamics/sensors/ranger.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

namespace hedgehop::dynamics::sensors {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kDt = 0.002;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

RangerConfig exact_ranger() {
  RangerConfig c;
  c.noise_m = c.noise_per_range = c.dropout = 0.0;
  return c;
}

std::optional<double> read(Ranger& ranger, double distance_m) {
  ranger.observe(distance_m);
  return ranger.read();
}

TEST(Ranger, NoiseGrowsWithTheRange) {
  RangerConfig c;
  c.dropout = 0.0;
  Ranger ranger("r", c, kDt, 5);
  constexpr int kCount = 20000;
  for (const auto& [range_m, sigma_m] :
       {std::pair{2.0, std::hypot(0.01, 0.01)}, std::pair{30.0, std::hypot(0.01, 0.15)}}) {
    double sum = 0.0, sum2 = 0.0;
    for (int i = 0; i < kCount; ++i) {
      const double error = *read(ranger, range_m) - range_m;
      sum += error, sum2 += error * error;
    }
    EXPECT_NEAR(sum / kCount, 0.0, 4.0 * sigma_m / std::sqrt(kCount));
    EXPECT_NEAR(std::sqrt(sum2 / kCount), sigma_m, 0.03 * sigma_m);
  }
}

TEST(Ranger, OffsetIsConstantDuringAFlight) {
  RangerConfig c = exact_ranger();
  c.offset_m = 0.05;
  constexpr int kFlights = 3000;
  double offsets2 = 0.0;
  for (int i = 0; i < kFlights; ++i) {
    Ranger ranger("r", c, kDt, static_cast<uint64_t>(i));
    const double first = *read(ranger, 10.0), later = *read(ranger, 20.0);
    ASSERT_NEAR(first - 10.0, later - 20.0, 1e-12);
    offsets2 += (first - 10.0) * (first - 10.0);
  }
  EXPECT_NEAR(std::sqrt(offsets2 / kFlights), c.offset_m, 0.05 * c.offset_m);
}

TEST(Ranger, DropoutsDoNotChangeOtherReadings) {
  RangerConfig sure, unsure;
  sure.dropout = 0.0;
  unsure.dropout = 0.2;
  Ranger a("r", sure, kDt, 5), b("r", unsure, kDt, 5);
  constexpr int kCount = 20000;
  int lost = 0;
  for (int i = 0; i < kCount; ++i) {
    const double reading = *read(a, 10.0);
    const std::optional<double> same = read(b, 10.0);
    if (same) {
      ASSERT_EQ(*same, reading);
    } else {
      ++lost;
    }
  }
  EXPECT_NEAR(static_cast<double>(lost) / kCount, 0.2, 0.012);
}

// Check AS6, with latencies below one period of 10 ticks, of whole periods, and between them.
TEST(Ranger, AS6_ReadingsOfAnApproachingWallAreDelayedByTheLatency) {
  constexpr double kSpeed = 4.0;
  for (const int64_t latency : {0, 3, 10, 25, 50}) {
    RangerConfig c = exact_ranger();
    c.latency_s = kDt * static_cast<double>(latency);
    Ranger ranger("r", c, kDt, 1);
    int looks = 0;
    for (int64_t tick = 0; tick < 1000; ++tick) {
      const double distance_m = 30.0 - kSpeed * kDt * static_cast<double>(tick);
      if (ranger.observes(tick)) {
        ranger.observe(distance_m);
        ++looks;
      }
      if (!ranger.due(tick)) continue;
      const std::optional<double> reading = ranger.read();
      ASSERT_EQ(reading.has_value(), tick >= latency) << tick << ' ' << latency;
      if (reading) {
        EXPECT_NEAR(*reading - distance_m, kSpeed * c.latency_s, 1e-9) << tick << ' ' << latency;
      }
    }
    EXPECT_EQ(looks, 100) << "once a reading";
  }
}

TEST(Ranger, HasNoReadingOutOfRangeOrIfDisabled) {
  const auto reads = [](const RangerConfig& c, double distance_m) {
    Ranger ranger("r", c, kDt, 1);
    return read(ranger, distance_m).has_value();
  };
  const RangerConfig on = exact_ranger();
  RangerConfig off = exact_ranger();
  off.enabled = false;
  EXPECT_FALSE(reads(on, 0.01));
  EXPECT_TRUE(reads(on, 0.03));
  EXPECT_TRUE(reads(on, 49.9));
  EXPECT_FALSE(reads(on, 50.1));
  EXPECT_FALSE(reads(on, kInfinity));
  EXPECT_FALSE(reads(on, std::nan("")));
  EXPECT_FALSE(reads(off, 10.0));
}

TEST(Ranger, RefusesInvalidConfigsByTheirKey) {
  const auto refuses = [](const RangerConfig& c, const char* key) {
    EXPECT_THAT([&] { Ranger("laser", c, kDt, 1); }, ThrowsMessage<std::invalid_argument>(HasSubstr(key)));
  };
  RangerConfig c;
  c.max_m = c.min_m;
  refuses(c, "laser.max: ");
  c = {};
  c.dropout = 1.5;
  refuses(c, "laser.dropout: ");
  c = {};
  c.latency_s = -0.1;
  refuses(c, "laser.latency: ");
  c = {};
  c.rate_hz = 30.0;
  refuses(c, "laser.rate: ");
}

TEST(RangeFinder, BeamDirectionIsNormalized) {
  RangeFinderConfig c;
  c.direction_B = {0.0, 3.0, 4.0};
  EXPECT_NEAR((beam_direction_B(c) - Eigen::Vector3d{0.0, 0.6, 0.8}).norm(), 0.0, 1e-15);
  c.direction_B.setZero();
  EXPECT_THAT([&] { beam_direction_B(c); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("range_finder.direction: ")));
}

}  // namespace
}  // namespace hedgehop::dynamics::sensors
