#include "dynamics/sensors/ranger.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "sim/fields/bounds.h"

namespace hedgehop::dynamics::sensors {
namespace {

/// A sonar 4 m above the ground.
HeightSensorConfig sonar() {
  HeightSensorConfig c;
  c.ranger.rate_hz = 20.0;
  c.ranger.max_m = 5.0;
  c.cone_rad = std::numbers::pi / 12.0;
  return c;
}

TEST(HeightSensor, ConeMeasuresTheGroundDirectlyBelow) {
  EXPECT_EQ(nearest_echo_m(sonar(), 4.0, [](double, double) { return 4.0; }), 4.0);
}

TEST(HeightSensor, ConeMeasuresTheNearestRoofWithinItsHalfAngle) {
  // A roof 3 m below with its edge at this distance north; the cone's radius there is 0.80 m.
  const auto echo_m = [](double edge_m) {
    return nearest_echo_m(sonar(), 4.0, [&](double north_m, double) { return north_m >= edge_m ? 3.0 : 4.0; });
  };
  constexpr double kRingM = 0.5;  // the edge is found within one ring
  EXPECT_GE(echo_m(0.3), std::hypot(3.0, 0.3));
  EXPECT_LE(echo_m(0.3), std::hypot(3.0, 0.3 + kRingM));
  EXPECT_EQ(echo_m(0.85), 4.0);  // outside
}

TEST(HeightSensor, BeamMeasuresOnlyTheSurfaceDirectlyBelow) {
  EXPECT_EQ(nearest_echo_m({}, 4.0, [](double, double) { return 1.0; }), 4.0);
}

TEST(HeightSensor, ConeWithoutASurfaceHasNoEcho) {
  constexpr double kNothing = std::numeric_limits<double>::infinity();
  EXPECT_EQ(nearest_echo_m(sonar(), kNothing, [](double, double) { return kNothing; }), kNothing);
}

TEST(HeightSensor, RefusesAConeThatIncludesTheHorizon) {
  HeightSensorConfig c;
  c.cone_rad = 1.0;
  EXPECT_THAT([&] { fields::require_bounds(c, "height_sensor"); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("height_sensor.cone: ")));
}

}  // namespace
}  // namespace hedgehop::dynamics::sensors
