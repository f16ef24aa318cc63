#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "dynamics/vehicle.h"

namespace hedgehop::dynamics::helicopter {
namespace {

/// Returns the error message for a default helicopter after a change.
template <class Change>
std::string refusal(const Change& change) {
  HelicopterConfig config;
  change(config);
  try {
    Vehicle vehicle{VehicleConfig(config)};
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "flies";
}
using C = HelicopterConfig;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(HelicopterRefusals, NameTheInvalidValue) {
  using testing::HasSubstr;
  EXPECT_EQ(refusal([](C&) {}), "flies");
  EXPECT_THAT(refusal([](C& c) { c.mass.mass_kg = -8.2; }), HasSubstr("mass.mass: must be > 0 kg, got -8.2"));
  EXPECT_THAT(refusal([](C& c) { c.mass.mass_kg = kNan; }), HasSubstr("mass.mass: must be finite, got nan"));
  EXPECT_THAT(refusal([](C& c) { c.mass.inertia_kgm2.x() = 1.0; }),
              HasSubstr("mass.inertia: is not that of a rigid body"));
  EXPECT_THAT(refusal([](C& c) { c.air_density_kgpm3 = 0.0; }), HasSubstr("air_density: must be > 0 kg/m3, got 0"));
  EXPECT_THAT(refusal([](C& c) { c.main_rotor.speed_radps = -167.0; }),
              HasSubstr("main_rotor.speed: must be > 0 rad/s, got -167"));
  EXPECT_THAT(refusal([](C& c) { c.main_rotor.radius_m = 0.0; }), HasSubstr("main_rotor.radius: must be > 0 m, got 0"));
  EXPECT_THAT(refusal([](C& c) { c.main_rotor.blade_inertia_kgm2 = 0.0; }), HasSubstr("main_rotor.blade_inertia"));
  EXPECT_THAT(refusal([](C& c) { c.tail_rotor.chord_m = -0.1; }),
              HasSubstr("tail_rotor.chord: must be > 0 m, got -0.1"));
  EXPECT_THAT(refusal([](C& c) { c.tail_rotor.gear_ratio = 0.0; }), HasSubstr("tail_rotor.gear_ratio"));
  EXPECT_THAT(refusal([](C& c) { c.main_rotor.hinge_offset_m = 0.5; }), HasSubstr("hinge_offset"));
  EXPECT_THAT(refusal([](C& c) { c.hull.fuselage_size_m.x() = 3.0; }),
              HasSubstr("the fuselage must end before the tail"));
}

TEST(HelicopterRefusals, NameTheFaultOfAServo) {
  using testing::HasSubstr;
  EXPECT_THAT(refusal([](C& c) { c.servos.cyclic.damping = 0.0; }),
              HasSubstr("servos.cyclic.damping: must be > 0, got 0"));
  EXPECT_THAT(refusal([](C& c) { c.servos.tail.damping = -0.5; }),
              HasSubstr("servos.tail.damping: must be > 0, got -0.5"));
  EXPECT_THAT(refusal([](C& c) { c.servos.tail.natural_frequency_radps = 0.0; }), HasSubstr("natural_frequency"));
  EXPECT_THAT(refusal([](C& c) { c.servos.tail.rate_limit_radps = kNan; }), HasSubstr("rate_limit"));
  EXPECT_THAT(refusal([](C& c) { c.servos.cyclic.lowest_rad = 0.2; }), HasSubstr("lowest angle must be below"));
}

TEST(HelicopterRefusals, NameTheReasonWithoutAHover) {
  using testing::HasSubstr;
  EXPECT_THAT(refusal([](C& c) { c.mass.mass_kg = 80.0; }), HasSubstr("no steady hover: it weighs 784.8 N, its main"));
  EXPECT_THAT(refusal([](C& c) { c.tail_rotor.radius_m = 0.06; }),
              HasSubstr("no steady hover: its tail rotor needs a thrust of"));
  EXPECT_THAT(refusal([](C& c) { c.servos.tail.highest_rad = 0.1; }), HasSubstr("the tail collective must be 11."));
  EXPECT_THAT(refusal([](C& c) { c.rotor_speed = GovernedEngineConfig{.max_power_w = 500.0}; }),
              HasSubstr("its engine gives 500"));
}

}  // namespace
}  // namespace hedgehop::dynamics::helicopter
