#include "dynamics/steady_flight.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace hedgehop::dynamics {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

TEST(Quantity, HasAMarginToTheNearerLimit) {
  const Quantity angle{"theta_c", "deg", 10.0, "", "", -12.0, 18.0};
  EXPECT_DOUBLE_EQ(angle.margin_percent(), 100.0 * 8.0 / 30.0);
  EXPECT_EQ(angle.beyond(), std::nullopt);
  const Quantity low{"theta_c", "deg", -15.0, "", "", -12.0, 18.0};
  EXPECT_DOUBLE_EQ(low.margin_percent(), -10.0);
  EXPECT_EQ(low.beyond(), "theta_c -15 deg, limit -12 deg");
  const Quantity power{"P", "W", 750.0, "", "", {}, 1000.0};
  EXPECT_DOUBLE_EQ(power.margin_percent(), 25.0);
}

TEST(SteadyFlight, NamesTheControlsBeyondTheirStops) {
  helicopter::HelicopterConfig config;
  config.servos.collective.highest_rad = 0.14;
  const auto hover = steady_flight(config, {0.0, 0.0, 0.0}), fast = steady_flight(config, {26.0, 0.0, 0.0});
  ASSERT_TRUE(hover && fast);
  EXPECT_THAT(hover->beyond(), ElementsAre());
  EXPECT_THAT(fast->beyond(), testing::Contains(HasSubstr("limit 8.021 deg")));
}

TEST(SteadyFlight, OfAMulticopterNamesRotorsThatAreTooSlow) {
  multicopter::MulticopterConfig config;
  config.body_drag_ns2pm2 = {0.02, 0.02, 0.02};
  config.rotor.highest_radps = 480.0;
  const auto fast = steady_flight(config, {16.0, 0.0, 0.0});
  ASSERT_TRUE(fast);
  EXPECT_THAT(fast->beyond(), testing::Contains(HasSubstr("omega_max")));
}

std::string refusal(const VehicleConfig& config) {
  try {
    Vehicle{config};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "flies";
}

TEST(PlausibleUnits, RecognizeARotorSpeedInRpm) {
  helicopter::HelicopterConfig config;
  config.main_rotor.radius_m = 1.54;
  config.main_rotor.speed_radps = 870.0;
  EXPECT_EQ(
      refusal(config),
      "main_rotor.speed: 870: tip speed 1340 m/s, faster than sound; 870 rpm is 91.1 rad/s; did you mean `rpm: 870`?");
  multicopter::MulticopterConfig multi;
  multi.rotor.highest_radps = 8000.0;
  EXPECT_THAT(refusal(multi), HasSubstr("did you mean `highest_rpm: 8000`?"));
}

TEST(PlausibleUnits, RecognizeMillimetersGramsAndInertiasOfOtherUnits) {
  const auto changed = [](auto change) {
    helicopter::HelicopterConfig config;
    change(config);
    return refusal(config);
  };
  EXPECT_THAT(changed([](auto& c) { c.main_rotor.radius_m = 775.0; }),
              AllOf(StartsWith("main_rotor.radius: 775:"), HasSubstr("a radius of 775 mm is 0.775 m")));
  EXPECT_THAT(changed([](auto& c) { c.main_rotor.chord_m = 58.0; }), HasSubstr("a chord of 58 mm is 0.058 m"));
  EXPECT_THAT(changed([](auto& c) { c.tail_rotor.arm_m = 910.0; }),
              AllOf(StartsWith("tail_rotor.arm:"), HasSubstr("910 mm is 0.91 m")));
  EXPECT_THAT(changed([](auto& c) { c.main_rotor.hub_height_m = 23.5; }),
              AllOf(StartsWith("main_rotor.hub_height:"), HasSubstr("23.5 cm is 0.235 m")));
  EXPECT_THAT(changed([](auto& c) { c.main_rotor.speed_radps = 167.0 * 0.10471975511965977; }),  // rad/s taken for rpm
              HasSubstr("did you mean `speed: 167`?"));
  EXPECT_THAT(changed([](auto& c) { c.mass.mass_kg = 8200.0; }), HasSubstr("a mass of 8200 g is 8.2 kg"));
  multicopter::MulticopterConfig multi;
  for (auto& arm : multi.arms) arm.azimuth_rad *= 0.017453292519943295;  // as if radians were written for degrees
  EXPECT_THAT(refusal(multi), AllOf(StartsWith("arms: "), HasSubstr("1.57 rad is 90 deg")));
  EXPECT_THAT(changed([](auto& c) { c.mass.inertia_kgm2 *= 1e4; }), HasSubstr("3400 kg cm2 is 0.34 kg m2"));
  EXPECT_THAT(changed([](auto& c) {
                constexpr double kRadPerDeg = 0.017453292519943295;
                c.servos.collective.lowest_rad *= kRadPerDeg;  // as if radians were written for degrees
                c.servos.collective.highest_rad *= kRadPerDeg;
              }),
              HasSubstr("0.314 rad is 18 deg"));
}

}  // namespace
}  // namespace hedgehop::dynamics
