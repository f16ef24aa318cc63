#include "sim/mavlink/steering.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace hedgehop::sim::mavlink {
namespace {

using avoidance::AttitudeCommand;
using avoidance::Command;
using avoidance::CommandType;
using avoidance::HoverCommand;
using avoidance::NavigationState;
using avoidance::PositionCommand;
using avoidance::VelocityCommand;

const Eigen::Vector3d p_stand_W(100.0, 50.0, -2.0);

NavigationState at_altitude(double altitude_m) {
  NavigationState navigation;
  navigation.p_WB_est = Eigen::Vector3d(110.0, 40.0, -altitude_m);
  return navigation;
}

/// The masks with which ArduPilot and PX4 read velocity with yaw, position with yaw, and velocity with yaw rate.
TEST(Steering, MasksSelectTheFieldsOfTheCommand) {
  const NavigationState navigation = at_altitude(10.0);
  EXPECT_EQ(to_setpoint(VelocityCommand{}, navigation, p_stand_W).type_mask, 0x09C7);
  EXPECT_EQ(to_setpoint(PositionCommand{}, navigation, p_stand_W).type_mask, 0x09F8);
  EXPECT_EQ(to_setpoint(HoverCommand{}, navigation, p_stand_W).type_mask, 0x05C7);
  EXPECT_EQ(to_setpoint(HoverCommand{}, navigation, p_stand_W).coordinate_frame, 1);
}

TEST(Steering, AltitudeErrorBecomesABoundedVerticalSpeed) {
  const auto vz = [](double commanded_m, double estimated_m) {
    return to_setpoint(VelocityCommand{{3.0, -1.0}, commanded_m, 0.5}, at_altitude(estimated_m), p_stand_W).vz;
  };
  EXPECT_FLOAT_EQ(vz(10.0, 10.25), 0.25f) << "too high: down";
  EXPECT_FLOAT_EQ(vz(10.0, 9.5), -0.5f);
  EXPECT_FLOAT_EQ(vz(10.0, 4.0), -2.0f);
  EXPECT_FLOAT_EQ(vz(10.0, 40.0), 2.0f);
  const auto setpoint = to_setpoint(VelocityCommand{{3.0, -1.0}, 10.0, 0.5}, at_altitude(10.25), p_stand_W);
  EXPECT_EQ(setpoint.vx, 3.0f);
  EXPECT_EQ(setpoint.vy, -1.0f);
  EXPECT_EQ(setpoint.yaw, 0.5f);
}

TEST(Steering, PositionsAreFromTheAutopilotsOrigin) {
  const auto setpoint = to_setpoint(PositionCommand{{103.0, 48.0, -12.0}, -1.0}, at_altitude(10.0), p_stand_W);
  EXPECT_EQ(setpoint.x, 3.0f);
  EXPECT_EQ(setpoint.y, -2.0f);
  EXPECT_EQ(setpoint.z, -10.0f);
  EXPECT_EQ(setpoint.yaw, -1.0f);
}

TEST(Steering, AttitudesAreRefused) {
  EXPECT_THROW(to_setpoint(AttitudeCommand{}, at_altitude(10.0), p_stand_W), std::invalid_argument);
  EXPECT_THROW(
      require_steerable(avoidance::Needs{.cameras = {}, .commands = {CommandType::velocity, CommandType::attitude}}),
      std::invalid_argument);
  EXPECT_NO_THROW(
      require_steerable(avoidance::Needs{.cameras = {}, .commands = {CommandType::velocity, CommandType::hover}}));
  EXPECT_NO_THROW(require_steerable(avoidance::Needs{}));
}

TEST(Steering, NewCommandsAreSentAtOnceAndOldOnesFiveTimesPerSecond) {
  Steering steering({1, 1}, p_stand_W);
  FrameWriter writer({1, 196});
  std::vector<int64_t> sent_ms;
  for (int64_t t_ms = 0; t_ms < 1000; t_ms += 10) {
    const Command command = t_ms < 250 ? Command(HoverCommand{}) : Command(VelocityCommand{{1.0, 0.0}, 10.0, 0.0});
    std::vector<uint8_t> bytes;
    steering.send(t_ms * 1'000'000, command, at_altitude(10.0), writer, bytes);
    if (bytes.empty()) continue;
    sent_ms.push_back(t_ms);
    FrameDecoder decoder;
    const auto message = decoder.decode(bytes).at(0).as<SetPositionTargetLocalNed>();
    EXPECT_EQ(message->time_boot_ms, t_ms);
    EXPECT_EQ(message->target_component, 1);
  }
  EXPECT_EQ(sent_ms, (std::vector<int64_t>{0, 200, 250, 450, 650, 850}));
}

}  // namespace
}  // namespace hedgehop::sim::mavlink
