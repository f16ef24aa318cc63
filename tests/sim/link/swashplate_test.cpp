#include "sim/link/swashplate.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace hedgehop::sim::link {
namespace {

using Type = HelicopterLinkConfig::Swashplate;

/// ArduPilot's forward mixing, as its table of factors lists it.
struct Forward {
  Type type;
  std::vector<double> roll, pitch, collective;
  double offset_of_first_two = 0.0;
};

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

const std::vector<Forward>& forwards() {
  const double s = std::cos(radians(30.0));
  static const std::vector<Forward> all = {
      {Type::h3_120, {0.866025, -0.866025, 0}, {0.5, 0.5, -1}, {1, 1, 1}},
      {Type::h3_140, {1, -1, 0}, {1, 1, -1}, {1, 1, 1}},
      {Type::h4_90, {1, -1, 0, 0}, {0, 0, -1, 1}, {1, 1, 1, 1}},
      {Type::h4_45, {0.707107, -0.707107, 0.707107, -0.707107}, {0.707107, 0.707107, -0.707, -0.707}, {1, 1, 1, 1}},
      {Type::h1, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0.5},
      {Type::h3, {s, -s, 0}, {0.5, 0.5, -1}, {1, 1, 1}},
  };
  return all;
}

std::vector<double> pulses(const Forward& f, const SwashCommand& c) {
  std::vector<double> us;
  for (size_t i = 0; i < f.roll.size(); ++i) {
    double u = 0.45 * (f.roll[i] * c.roll + f.pitch[i] * c.pitch) + f.collective[i] * c.collective;
    if (i < 2) u += f.offset_of_first_two;
    us.push_back(1000.0 * u + 1500.0 - 500.0);
  }
  return us;
}

TEST(Swashplate, InverseUndoesArduPilotsMixingOfEveryType) {
  for (const Forward& forward : forwards()) {
    const SwashplateInverse inverse(HelicopterLinkConfig{.swashplate = forward.type});
    EXPECT_EQ(swash_servos(forward.type), forward.roll.size());
    for (const SwashCommand& c : {SwashCommand{0.5, 0, 0}, {0.3, 0.4, -0.2}, {0.7, -0.55, 0.55}, {0.25, 0.1, 0.3}}) {
      const SwashCommand back = inverse.command(pulses(forward, c));
      EXPECT_NEAR(back.collective, c.collective, 1e-9) << static_cast<int>(forward.type);
      EXPECT_NEAR(back.roll, c.roll, 1e-9) << static_cast<int>(forward.type);
      EXPECT_NEAR(back.pitch, c.pitch, 1e-9) << static_cast<int>(forward.type);
    }
  }
}

TEST(Swashplate, InverseEqualsTheClosedFormsOfTheTable) {
  const std::array<double, 4> us{1612.0, 1403.0, 1555.0, 1470.0};
  const auto u = [&](size_t i) { return (us[i] - 1000.0) / 1000.0; };
  const auto expect = [&](Type type, double collective, double roll, double pitch, double tolerance) {
    const SwashCommand c = SwashplateInverse(HelicopterLinkConfig{.swashplate = type}).command(us);
    EXPECT_NEAR(c.collective, collective, tolerance);
    EXPECT_NEAR(c.roll, roll, tolerance);
    EXPECT_NEAR(c.pitch, pitch, tolerance);
  };
  constexpr double kPrinted = 1e-6, kRear = 2e-5;  // digits of the table; its rear factor is 0.707
  expect(Type::h3_120, (u(0) + u(1) + u(2)) / 3, (u(0) - u(1)) / 0.7794225, ((u(0) + u(1)) / 2 - u(2)) / 0.675,
         kPrinted);
  expect(Type::h3_140, (u(0) + u(1) + 2 * u(2)) / 4, (u(0) - u(1)) / 0.9, (u(0) + u(1) - 2 * u(2)) / 1.8, kPrinted);
  expect(Type::h4_90, (u(0) + u(1) + u(2) + u(3)) / 4, (u(0) - u(1)) / 0.9, (u(3) - u(2)) / 0.9, kPrinted);
  expect(Type::h4_45, (u(0) + u(1) + u(2) + u(3)) / 4, (u(0) - u(1) + u(2) - u(3)) / 1.272793,
         (u(0) + u(1) - u(2) - u(3)) / 1.272697, kRear);
  expect(Type::h1, u(2), (u(0) - 0.5) / 0.45, (u(1) - 0.5) / 0.45, kPrinted);
}

TEST(Swashplate, ReversedCollectiveAndTrimsAreUndone) {
  HelicopterLinkConfig config{
      .swashplate = Type::h3_120, .trim_us = {1520.0, 1480.0, 1500.0}, .collective_reversed = true};
  std::vector<double> us = pulses(forwards()[0], {0.3, 0.2, -0.1});
  us[0] += 20.0;
  us[1] -= 20.0;
  const SwashCommand c = SwashplateInverse(config).command(us);
  EXPECT_NEAR(c.collective, 0.7, 1e-9);
  EXPECT_NEAR(c.roll, 0.2, 1e-9);
  EXPECT_NEAR(c.pitch, -0.1, 1e-9);
}

TEST(Swashplate, ServosInOneLineAreRefused) {
  HelicopterLinkConfig config{.swashplate = Type::h3, .h3_azimuth_rad = {0.0, 0.0, radians(180.0)}};
  EXPECT_THROW(SwashplateInverse{config}, std::invalid_argument);
}

}  // namespace
}  // namespace hedgehop::sim::link
