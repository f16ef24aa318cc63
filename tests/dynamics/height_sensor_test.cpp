#include "dynamics/height_sensor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "dynamics/magnetometer.h"

namespace hedgehop::dynamics {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(HeightSensor, NoiseGrowsWithTheRange) {
  HeightSensorConfig c;
  c.dropout = 0.0;
  HeightSensor sensor(c, 0.002, 5);
  constexpr int kCount = 20000;
  for (const auto& [range_m, sigma_m] :
       {std::pair{1.0, std::hypot(0.01, 0.005)}, std::pair{20.0, std::hypot(0.01, 0.1)}}) {
    double sum = 0.0, sum2 = 0.0;
    for (int i = 0; i < kCount; ++i) {
      const double error = *sensor.read(range_m) - range_m;
      sum += error, sum2 += error * error;
    }
    EXPECT_NEAR(sum / kCount, 0.0, 4.0 * sigma_m / std::sqrt(kCount));
    EXPECT_NEAR(std::sqrt(sum2 / kCount), sigma_m, 0.03 * sigma_m);
  }
}

TEST(HeightSensor, LosesItsShareOfReadingsWithoutDisturbingTheOthers) {
  HeightSensorConfig sure, unsure;
  sure.dropout = 0.0;
  unsure.dropout = 0.2;
  HeightSensor a(sure, 0.002, 5), b(unsure, 0.002, 5);
  constexpr int kCount = 20000;
  int lost = 0;
  for (int i = 0; i < kCount; ++i) {
    const double reading = *a.read(10.0);
    const std::optional<double> same = b.read(10.0);
    if (!same) ++lost;
    if (same) {
      ASSERT_EQ(*same, reading);
    }
  }
  EXPECT_NEAR(static_cast<double>(lost) / kCount, 0.2, 0.012);
}

TEST(HeightSensor, IsBlindOutOfRange) {
  HeightSensorConfig c;
  c.dropout = 0.0;
  HeightSensor sensor(c, 0.002, 5);
  EXPECT_FALSE(sensor.read(0.01).has_value());
  EXPECT_TRUE(sensor.read(49.9).has_value());
  EXPECT_FALSE(sensor.read(50.1).has_value());
  EXPECT_FALSE(sensor.read(std::numeric_limits<double>::infinity()).has_value());
  EXPECT_FALSE(sensor.read(std::nan("")).has_value());
}

/// A sonar 4 m above the ground.
HeightSensorConfig sonar() {
  HeightSensorConfig c;
  c.rate_hz = 20.0;
  c.max_m = 5.0;
  c.cone_rad = std::numbers::pi / 12.0;
  return c;
}

TEST(HeightSensor, AConeHearsTheGroundRightBelow) {
  EXPECT_EQ(nearest_echo_m(sonar(), 4.0, [](double, double) { return 4.0; }), 4.0);
}

TEST(HeightSensor, AConeHearsTheNearestRoofWithinItsHalfAngle) {
  // A roof 3 m below that begins so far to the north: the cone is 0.80 m wide there.
  const auto echo_m = [](double edge_m) {
    return nearest_echo_m(sonar(), 4.0, [&](double north_m, double) { return north_m >= edge_m ? 3.0 : 4.0; });
  };
  constexpr double kRingM = 0.5;  // the edge is found to the ring beyond it
  EXPECT_GE(echo_m(0.3), std::hypot(3.0, 0.3));
  EXPECT_LE(echo_m(0.3), std::hypot(3.0, 0.3 + kRingM));
  EXPECT_EQ(echo_m(0.85), 4.0);  // outside
}

TEST(HeightSensor, ABeamMindsOnlyWhatIsRightBelow) {
  EXPECT_EQ(nearest_echo_m({}, 4.0, [](double, double) { return 1.0; }), 4.0);
}

TEST(HeightSensor, AConeOverNothingHearsNothing) {
  constexpr double kNothing = std::numeric_limits<double>::infinity();
  EXPECT_EQ(nearest_echo_m(sonar(), kNothing, [](double, double) { return kNothing; }), kNothing);
}

TEST(HeightSensor, RefusesWhatCannotBe) {
  HeightSensorConfig c;
  c.max_m = c.min_m;
  EXPECT_THAT([&] { HeightSensor(c, 0.002, 1); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("height_sensor.max: ")));
  c = {};
  c.dropout = 1.5;
  EXPECT_THAT([&] { HeightSensor(c, 0.002, 1); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("height_sensor.dropout: ")));
  c = {};
  c.cone_rad = 1.0;
  EXPECT_THAT([&] { HeightSensor(c, 0.002, 1); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("height_sensor.cone: ")));
}

TEST(Magnetometer, KeepsItsOffsetAndScattersRoundIt) {
  const MagnetometerConfig c;
  constexpr int kFlights = 3000;
  double offsets2 = 0.0, noise2 = 0.0;
  for (int i = 0; i < kFlights; ++i) {
    Magnetometer compass(c, 0.002, static_cast<uint64_t>(i));
    offsets2 += std::pow(compass.offset_rad(), 2);
    noise2 += std::pow(compass.read(1.0) - 1.0 - compass.offset_rad(), 2);
  }
  EXPECT_NEAR(std::sqrt(offsets2 / kFlights), c.offset_rad, 0.05 * c.offset_rad);
  EXPECT_NEAR(std::sqrt(noise2 / kFlights), c.noise_rad, 0.05 * c.noise_rad);
}

TEST(Magnetometer, ReadsWithinHalfATurn) {
  Magnetometer compass({}, 0.002, 3);
  for (int i = 0; i < 100; ++i) EXPECT_LE(std::abs(compass.read(3.14159)), 3.14159265358979324);
}

}  // namespace
}  // namespace hedgehop::dynamics
