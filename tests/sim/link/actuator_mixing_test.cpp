#include "sim/link/actuator_mixing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "sim/fields/quantities.h"
#include "sim/scenario/motor_frames.h"
#include "sim/scenario/scenario.h"
#include "sim/scenario/validate.h"

namespace hedgehop::sim::link {
namespace {

using dynamics::multicopter::ArmConfig;
using dynamics::multicopter::MulticopterConfig;

ArmConfig arm(double azimuth_deg, bool clockwise) {
  return {azimuth_deg / kDegPerRad, 0.2, clockwise ? ArmConfig::Turns::clockwise : ArmConfig::Turns::counter_clockwise};
}

ServoPacket packet_of(std::initializer_list<int> pulses) {
  ServoPacket packet{.outputs = 16};
  std::ranges::copy(pulses, packet.pulse_us.begin());
  return packet;
}

/// Rotor speeds as shares of the maximum, in the order of the arms.
std::vector<double> shares(const MulticopterConfig& vehicle, const MulticopterLinkConfig& frame,
                           const ServoPacket& packet) {
  ArduPilotLinkConfig link;
  link.multicopter = frame;
  const auto speeds =
      std::get<dynamics::multicopter::PerRotor>(ActuatorMixing(link, vehicle).command(packet).actuators);
  std::vector<double> all;
  for (const double speed_radps : speeds) all.push_back(speed_radps / vehicle.rotor.highest_radps);
  return all;
}

testing::Matcher<std::vector<double>> shares_of(std::vector<double> wanted) {
  return testing::Pointwise(testing::DoubleNear(1e-12), std::move(wanted));
}

TEST(ActuatorMixing, PulsesOfAQuadXReachTheArmsByAzimuth) {
  MulticopterConfig vehicle;
  // Front right, rear right, rear left, front left: the motors 1, 4, 2, 3 of ArduPilot's quad X.
  vehicle.arms = {arm(45, false), arm(135, true), arm(-135, false), arm(-45, true)};
  const std::vector<double> speeds =
      shares(vehicle, {.frame_class = 1, .frame_type = 1}, packet_of({1100, 1200, 1300, 1400}));
  EXPECT_THAT(speeds, shares_of({0.1, 0.4, 0.2, 0.3}));
}

TEST(ActuatorMixing, HummingbirdIsAQuadPlus) {
  const std::vector<double> speeds =
      shares(MulticopterConfig{}, {.frame_class = 1, .frame_type = 0}, packet_of({1100, 1200, 1300, 1400}));
  EXPECT_THAT(speeds, shares_of({0.3, 0.1, 0.4, 0.2}));  // forward, right, back, left
}

TEST(ActuatorMixing, PulsesBeyondTheRangeAreLimitedAndNoPulseStopsAMotor) {
  const std::vector<double> speeds =
      shares(MulticopterConfig{}, {.frame_class = 1, .frame_type = 0, .pwm_min_us = 1100.0, .pwm_max_us = 1900.0},
             packet_of({900, 2100, 0, 1500}));
  EXPECT_THAT(speeds, shares_of({0.0, 0.0, 0.5, 1.0}));
}

TEST(MotorFrames, EveryFrameMatchesAVehicleBuiltFromItsTable) {
  for (const auto& [frame_class, frame_type] : std::vector<std::pair<int64_t, int64_t>>{
           {1, 0}, {1, 1}, {1, 12}, {1, 13}, {1, 14}, {2, 0}, {2, 1}, {3, 0}, {3, 1}, {4, 1}}) {
    MulticopterConfig vehicle;
    vehicle.arms.clear();
    const auto motors = frame_motors(frame_class, frame_type);
    double turn = 0.0;
    for (const FrameMotor& motor : motors) {
      vehicle.arms.push_back(arm(motor.azimuth_deg + 360.0, motor.clockwise));  // the same direction
      turn += motor.clockwise ? 1.0 : -1.0;
    }
    EXPECT_EQ(turn, 0.0) << frame_class << ' ' << frame_type;  // no torque about the vertical in hover
    std::ranges::reverse(vehicle.arms);
    const MotorMatch match = match_motors(vehicle, frame_class, frame_type);
    ASSERT_TRUE(match.errors.empty()) << match.errors.front().text();
    for (size_t m = 0; m < motors.size(); ++m) {
      const ArmConfig& matched = vehicle.arms[match.arm_of_motor[m]];
      EXPECT_NEAR(std::remainder(matched.azimuth_rad * kDegPerRad - motors[m].azimuth_deg, 360.0), 0.0, 1e-9);
      EXPECT_EQ(matched.turns == ArmConfig::Turns::clockwise, motors[m].clockwise);
    }
    std::vector<size_t> arms = match.arm_of_motor;
    std::ranges::sort(arms);
    EXPECT_TRUE(std::ranges::adjacent_find(arms) == arms.end());
  }
}

TEST(MotorFrames, ArmOfAnotherSenseOrAzimuthIsNamed) {
  MulticopterConfig vehicle;
  vehicle.arms = {arm(90, true), arm(30, true), arm(-30, true), arm(150, false), arm(-90, false), arm(-150, true)};
  MotorMatch match = match_motors(vehicle, 2, 1);
  ASSERT_EQ(match.errors.size(), 1u);
  EXPECT_EQ(match.errors[0].path, "vehicle.arms");
  EXPECT_EQ(match.errors[0].message, "arm 2 (30, clockwise) is no motor of FRAME_CLASS 2, TYPE 1");
  vehicle.arms[1] = arm(41, false);
  match = match_motors(vehicle, 2, 1);
  ASSERT_EQ(match.errors.size(), 1u);
  EXPECT_EQ(match.errors[0].message, "arm 2 (41, counter_clockwise) is no motor of FRAME_CLASS 2, TYPE 1");
  vehicle.arms[1] = arm(39, false);
  EXPECT_TRUE(match_motors(vehicle, 2, 1).errors.empty());
}

TEST(MotorFrames, AnotherNumberOfArmsAndAnUnknownFrameAreRefused) {
  EXPECT_EQ(match_motors(MulticopterConfig{}, 2, 1).errors.at(0).message, "4 arms; FRAME_CLASS 2, TYPE 1 has 6 motors");
  const FieldError of_class = match_motors(MulticopterConfig{}, 9, 3).errors.at(0);
  EXPECT_EQ(of_class.text(), "'link.multicopter.frame_class': 9 is unknown; valid: 1, 2, 3, 4");
  const FieldError of_type = match_motors(MulticopterConfig{}, 1, 99, "link").errors.at(0);
  EXPECT_EQ(of_type.text(), "'link.frame_type': 99 is not for frame_class 1; valid: 0, 1, 12, 13, 14");
}

TEST(MotorFrames, EveryErrorOfALinkIsNamedByItsKey) {
  Scenario scenario;
  scenario.vehicle = MulticopterConfig{};
  const auto paths = [&](const LinkConfig& link) {
    scenario.link = link;
    std::vector<std::string> all;
    for (const FieldError& error : link_errors(scenario)) all.push_back(error.path);
    return all;
  };
  const MulticopterLinkConfig inverted = {.frame_type = 0, .pwm_min_us = 1900.0, .pwm_max_us = 1100.0};
  EXPECT_THAT(paths(ArduPilotLinkConfig{.multicopter = inverted}), testing::ElementsAre("link.multicopter.pwm_max"));
  const MulticopterLinkConfig unknown = {.frame_type = 99};
  EXPECT_THAT(paths(ArduPilotLinkConfig{.multicopter = unknown}), testing::ElementsAre("link.multicopter.frame_type"));
  EXPECT_THAT(paths(Px4LinkConfig{.frame_type = 99}), testing::ElementsAre("link.frame_type"));
  const MulticopterLinkConfig plus = {.frame_type = 0};
  EXPECT_THAT(paths(ArduPilotLinkConfig{.host = "foo", .multicopter = plus}), testing::ElementsAre("link.host"));
  EXPECT_EQ(link_errors(scenario).at(0).message, "must be a numeric IPv4 address such as 127.0.0.1, got 'foo'");
}

class HelicopterPulses : public testing::Test {
 protected:
  HelicopterPulses() {
    link_.helicopter = HelicopterLinkConfig{};
    link_.helicopter->collective_low_rad = -2.0 / kDegPerRad;
    link_.helicopter->collective_high_rad = 12.0 / kDegPerRad;
    link_.helicopter->tail_trim_rad = 5.0 / kDegPerRad;
  }
  OutsideCommand command(const ServoPacket& packet) const { return ActuatorMixing(link_, vehicle_).command(packet); }
  dynamics::Controls blades_deg(const ServoPacket& packet) const {
    return kDegPerRad * std::get<dynamics::Controls>(command(packet).actuators);
  }

  ArduPilotLinkConfig link_;
  dynamics::helicopter::HelicopterConfig vehicle_;
};

TEST_F(HelicopterPulses, CollectiveIsLinearBetweenItsNamedAngles) {
  EXPECT_NEAR(blades_deg(packet_of({1250, 1250, 1250, 1500}))[dynamics::kHeave], -2.0, 1e-9);
  EXPECT_NEAR(blades_deg(packet_of({1500, 1500, 1500, 1500}))[dynamics::kHeave], 5.0, 1e-9);
  EXPECT_NEAR(blades_deg(packet_of({1750, 1750, 1750, 1500}))[dynamics::kHeave], 12.0, 1e-9);
  EXPECT_NEAR(blades_deg(packet_of({1000, 1000, 1000, 1500}))[dynamics::kHeave], -2.0, 1e-9);
}

TEST_F(HelicopterPulses, FullCyclicIsTheStopOfTheBlades) {
  const double full = 2500.0 / 4500.0;
  const int side = static_cast<int>(std::lround(1000.0 * 0.45 * 0.866025 * full));
  const dynamics::Controls right = blades_deg(packet_of({1500 + side, 1500 - side, 1500, 1500}));
  EXPECT_NEAR(right[dynamics::kRoll], 8.0, 0.02);  // whole microseconds
  EXPECT_NEAR(right[dynamics::kPitch], 0.0, 1e-9);
  const dynamics::Controls up = blades_deg(packet_of({1500 + 125, 1500 + 125, 1500 - 250, 1500}));
  EXPECT_NEAR(up[dynamics::kPitch], 8.0, 0.02);
  EXPECT_NEAR(up[dynamics::kRoll], 0.0, 1e-9);
  EXPECT_NEAR(up[dynamics::kHeave], 5.0, 1e-9);
}

TEST_F(HelicopterPulses, TailPulseAboveItsTrimTurnsRightUnderEitherRotor) {
  EXPECT_NEAR(blades_deg(packet_of({1500, 1500, 1500, 1500}))[dynamics::kYaw], 5.0, 1e-9);
  EXPECT_NEAR(blades_deg(packet_of({1500, 1500, 1500, 1900}))[dynamics::kYaw], 20.0, 1e-9);
  EXPECT_NEAR(blades_deg(packet_of({1500, 1500, 1500, 1100}))[dynamics::kYaw], -20.0, 1e-9);
  EXPECT_NEAR(blades_deg(packet_of({1500, 1500, 1500, 1700}))[dynamics::kYaw], 12.5, 1e-9);
  vehicle_.main_rotor.turns = dynamics::helicopter::MainRotorConfig::Turns::counter_clockwise;
  EXPECT_NEAR(blades_deg(packet_of({1500, 1500, 1500, 1900}))[dynamics::kYaw], -20.0, 1e-9);
}

TEST_F(HelicopterPulses, ThrottleAboveFourTenthsRunsTheEngine) {
  EXPECT_FALSE(command(packet_of({1500, 1500, 1500, 1500, 0, 0, 0, 1400})).engine_on);
  EXPECT_TRUE(command(packet_of({1500, 1500, 1500, 1500, 0, 0, 0, 1700})).engine_on);
  EXPECT_FALSE(command(packet_of({1500, 1500, 1500, 1500, 0, 0, 0, 0})).engine_on);
}

TEST_F(HelicopterPulses, AServoWithoutPulseKeepsItsLastOne) {
  ActuatorMixing mixing(link_, vehicle_);
  const auto yaw_deg = [&](int pulse) {
    return kDegPerRad * std::get<dynamics::Controls>(mixing.command(packet_of({1500, 1500, 1500, pulse})).actuators)[3];
  };
  EXPECT_NEAR(yaw_deg(0), 5.0, 1e-9);
  EXPECT_NEAR(yaw_deg(1900), 20.0, 1e-9);
  EXPECT_NEAR(yaw_deg(0), 20.0, 1e-9);
}

TEST_F(HelicopterPulses, HelicopterWithoutServosIsRefused) {
  link_.helicopter.reset();
  EXPECT_THROW(ActuatorMixing(link_, vehicle_), InputError);
}

}  // namespace
}  // namespace hedgehop::sim::link
