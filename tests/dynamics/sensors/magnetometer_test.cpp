#include "dynamics/sensors/magnetometer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <stdexcept>

namespace hedgehop::dynamics::sensors {
namespace {

TEST(Magnetometer, OffsetIsConstantWithNoiseAroundIt) {
  const MagnetometerConfig c;
  constexpr int kFlights = 3000;
  double offsets2 = 0.0, noise2 = 0.0;
  for (int i = 0; i < kFlights; ++i) {
    Magnetometer compass(c, 0.002, static_cast<uint64_t>(i));
    offsets2 += std::pow(compass.offset_rad(), 2);
    noise2 += std::pow(*compass.read(1.0) - 1.0 - compass.offset_rad(), 2);
  }
  EXPECT_NEAR(std::sqrt(offsets2 / kFlights), c.offset_rad, 0.05 * c.offset_rad);
  EXPECT_NEAR(std::sqrt(noise2 / kFlights), c.noise_rad, 0.05 * c.noise_rad);
}

TEST(Magnetometer, HeadingIsWithinHalfATurn) {
  Magnetometer compass({}, 0.002, 3);
  for (int i = 0; i < 100; ++i) EXPECT_LE(std::abs(*compass.read(3.14159)), 3.14159265358979324);
}

TEST(Magnetometer, DropsTheConfiguredShareOfReadings) {
  MagnetometerConfig c;
  c.dropout = 0.2;
  Magnetometer compass(c, 0.002, 4);
  constexpr int kCount = 20000;
  int lost = 0;
  for (int i = 0; i < kCount; ++i) lost += compass.read(1.0) ? 0 : 1;
  EXPECT_NEAR(static_cast<double>(lost) / kCount, 0.2, 0.012);
}

TEST(Magnetometer, HasNoReadingIfDisabledAndRefusesAProbabilityAboveOne) {
  MagnetometerConfig c;
  c.enabled = false;
  EXPECT_FALSE(Magnetometer(c, 0.002, 1).read(1.0).has_value());
  c.dropout = 1.1;
  EXPECT_THAT([&] { Magnetometer(c, 0.002, 1); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("magnetometer.dropout: ")));
}

}  // namespace
}  // namespace hedgehop::dynamics::sensors
