#include "sim/mavlink/companion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "sim/mavlink/perception_messages.h"
#include "tests/sim/mavlink/scripted_autopilot.h"

namespace hedgehop::sim::mavlink {
namespace {

constexpr uint8_t kArduPilotMake = 3, kPx4Make = 12;
constexpr int64_t kStepNs = 10'000'000, kSecondNs = 1'000'000'000;

using avoidance::CameraNeed;
using avoidance::CommandType;

CompanionSetup on_stand(AutopilotMake make) {
  CompanionSetup setup{.make = make};
  setup.p_origin_W = Eigen::Vector3d(5.0, -3.0, 0.0);
  setup.p_start_W = Eigen::Vector3d(5.0, -3.0, -8.0);
  setup.start_heading_rad = 0.5;
  return setup;
}

/// A companion and an autopilot, with the time of both.
struct Pair {
  Companion companion;
  ScriptedAutopilot autopilot;
  int64_t t_ns = 0;
  std::map<uint32_t, std::vector<Frame>> sent;  ///< by the companion, by id

  Pair(const CompanionConfig& config, const CompanionSetup& setup)
      : companion(config, setup), autopilot(static_cast<uint8_t>(setup.make)) {}

  void step(const avoidance::NavigationState* navigation = nullptr, const avoidance::Command* command = nullptr) {
    std::vector<uint8_t> bytes;
    companion.send(t_ns, navigation, command, bytes);
    for (const Frame& frame : decoder_.decode(bytes)) sent[frame.id].push_back(frame);
    companion.receive(autopilot.exchange(t_ns, bytes));
    t_ns += kStepNs;
  }
  void run_for(double duration_s) {
    for (const int64_t end_ns = t_ns + static_cast<int64_t>(1e9 * duration_s); t_ns < end_ns;) step();
  }
  /// Runs until the autopilot is armed, at most for a minute.
  void run_until_armed() {
    for (const int64_t end_ns = t_ns + 60 * kSecondNs; !autopilot.armed && t_ns < end_ns;) step();
  }

 private:
  FrameDecoder decoder_;
};

TEST(Companion, StartsArduPilotWhenItsFilterHasAPosition) {
  Pair pair({}, on_stand(AutopilotMake::ardupilot));
  pair.run_for(19.0);
  EXPECT_EQ(pair.autopilot.mode, 0u);
  EXPECT_EQ(pair.companion.awaited(), "its position estimate");
  pair.run_for(8.0);
  EXPECT_EQ(pair.autopilot.mode, 4u) << "GUIDED";
  EXPECT_TRUE(pair.autopilot.armed);
  EXPECT_TRUE(pair.autopilot.took_off);
  EXPECT_EQ(pair.autopilot.climb_m, 8.0f);
  EXPECT_EQ(std::ranges::count(pair.autopilot.commands, 400), 3) << "two requests to arm were refused";
  EXPECT_EQ(std::ranges::count(pair.autopilot.commands, 22), 1);
  EXPECT_TRUE(pair.autopilot.setpoints.empty());
  EXPECT_TRUE(pair.autopilot.overrides.empty());
  EXPECT_EQ(pair.companion.awaited(), "its arrival at the start (its last message: PreArm: Need Position Estimate)");
}

TEST(Companion, ArmsAgainAfterArduPilotDisarmedOnTheGround) {
  Pair pair({}, on_stand(AutopilotMake::ardupilot));
  pair.autopilot.refused_armings = 0;
  pair.autopilot.refuses_take_off = true;
  pair.run_until_armed();
  ASSERT_TRUE(pair.autopilot.armed);
  pair.run_for(1.5);  // a heartbeat reports it
  pair.autopilot.armed = pair.autopilot.refuses_take_off = false;
  pair.autopilot.commands.clear();
  pair.run_for(5.0);
  EXPECT_GE(std::ranges::count(pair.autopilot.commands, 400), 1);
  EXPECT_TRUE(pair.autopilot.took_off);
}

TEST(Companion, SwitchesTheInterlockOfAHelicopterOffToArmAndOnToFly) {
  CompanionSetup setup = on_stand(AutopilotMake::ardupilot);
  setup.has_interlock = true;
  Pair pair({}, setup);
  pair.run_until_armed();
  ASSERT_TRUE(pair.autopilot.armed);
  ASSERT_FALSE(pair.autopilot.overrides.empty());
  for (const RcChannelsOverride& channels : pair.autopilot.overrides) {
    EXPECT_EQ(channels.channels[7], 1000);
    EXPECT_EQ(channels.channels[2], 65535) << "other channels stay as they are";
  }
  EXPECT_NE(pair.autopilot.mode, 4u) << "GUIDED keeps the rotor at idle";
  pair.run_for(3.0);
  EXPECT_EQ(pair.autopilot.overrides.back().channels[7], 2000);
  EXPECT_EQ(pair.companion.awaited().substr(0, 23), "the run-up of its rotor");
  pair.run_for(25.0);
  EXPECT_EQ(pair.autopilot.mode, 4u);
  EXPECT_TRUE(pair.autopilot.took_off);
}

TEST(Companion, StreamsTheStartToPx4BeforeOffboardMode) {
  Pair pair({}, on_stand(AutopilotMake::px4));
  pair.run_for(30.0);
  EXPECT_EQ(pair.autopilot.mode, 6u << 16);
  EXPECT_TRUE(pair.autopilot.armed);
  EXPECT_EQ(std::ranges::count(pair.autopilot.commands, 22), 0);
  const SetPositionTargetLocalNed setpoint = pair.autopilot.setpoints.back();
  EXPECT_EQ(setpoint.type_mask, 0x09F8);
  EXPECT_EQ(setpoint.z, -8.0f);
  EXPECT_EQ(setpoint.x, 0.0f);
  EXPECT_EQ(setpoint.yaw, 0.5f);
  for (size_t i = 1; i < pair.autopilot.setpoint_times_ns.size(); ++i) {
    EXPECT_LT(pair.autopilot.setpoint_times_ns[i] - pair.autopilot.setpoint_times_ns[i - 1], kSecondNs / 2);
  }
}

TEST(Companion, SendsTheModulesCommandsFromTheStartOfTheFlight) {
  Pair pair({}, on_stand(AutopilotMake::ardupilot));
  pair.run_for(30.0);
  avoidance::NavigationState navigation;
  navigation.p_WB_est = Eigen::Vector3d(5.0, -3.0, -8.0);
  const avoidance::Command command = avoidance::VelocityCommand{{2.0, 1.0}, 8.5, 0.25};
  for (int i = 0; i < 100; ++i) pair.step(&navigation, &command);
  ASSERT_EQ(pair.autopilot.setpoints.size(), 5u);
  EXPECT_EQ(pair.autopilot.setpoints[0].vx, 2.0f);
  EXPECT_FLOAT_EQ(pair.autopilot.setpoints[0].vz, -0.5f);
  EXPECT_EQ(pair.autopilot.setpoints[0].target_system, 1);
}

TEST(Companion, LeavesTheAutopilotAloneIfItDoesNotSteer) {
  Pair pair({.steer = false}, on_stand(AutopilotMake::ardupilot));
  pair.run_for(30.0);
  avoidance::NavigationState navigation;
  const avoidance::Command command = avoidance::AttitudeCommand{};
  pair.step(&navigation, &command);
  EXPECT_TRUE(pair.autopilot.commands.empty());
  EXPECT_TRUE(pair.autopilot.setpoints.empty());
  EXPECT_EQ(pair.sent[Heartbeat::kId].size(), 31u) << "one per second";
  EXPECT_EQ(pair.companion.awaited(), "");
}

TEST(Companion, RefusesAttitudesBeforeTheFlightIfTheyAreDeclaredElseAtTheFirst) {
  CompanionSetup setup = on_stand(AutopilotMake::ardupilot);
  Pair pair({}, setup);
  avoidance::NavigationState navigation;
  const avoidance::Command command = avoidance::AttitudeCommand{};
  std::vector<uint8_t> bytes;
  EXPECT_THROW(pair.companion.send(pair.t_ns, &navigation, &command, bytes), std::invalid_argument);
  setup.needs.commands = {CommandType::attitude};
  EXPECT_THROW(Companion({}, setup), std::invalid_argument);
  EXPECT_NO_THROW(Companion({.steer = false}, setup));
}

TEST(Companion, ReportsAnotherProtocolVersion) {
  Pair pair({}, on_stand(AutopilotMake::ardupilot));
  pair.autopilot.version = 4;
  pair.run_for(2.0);
  EXPECT_EQ(pair.companion.fault(), "protocol version 4 in HEARTBEAT; valid: 3");
  EXPECT_FALSE(pair.companion.autopilot().sender());

  Companion companion({}, on_stand(AutopilotMake::ardupilot));
  EXPECT_EQ(companion.fault(), "");
  companion.receive(std::vector<uint8_t>{0xFE, 9, 0, 1, 1, 0, 0, 0, 0, 0, 2, 3, 0, 4, 3, 0x11, 0x22});
  EXPECT_EQ(companion.fault(), "MAVLink 1; valid: MAVLink 2");
}

TEST(Companion, FollowsTheFirstAutopilotOfItsMakeOnly) {
  Companion companion({}, on_stand(AutopilotMake::ardupilot));
  const auto hear = [&](Sender sender, uint8_t make, uint32_t mode) {
    std::vector<uint8_t> bytes;
    FrameWriter(sender).append(Heartbeat{.custom_mode = mode, .autopilot = make}, bytes);
    companion.receive(bytes);
  };
  hear({255, 190}, 8, 1);     // a ground station
  hear({2, 1}, kPx4Make, 2);  // another make
  EXPECT_FALSE(companion.autopilot().sender());
  hear({1, 1}, kArduPilotMake, 3);
  hear({7, 1}, kArduPilotMake, 4);
  EXPECT_EQ(companion.autopilot().sender()->system, 1);
  EXPECT_EQ(companion.autopilot().custom_mode(), 3u);
}

/// A vehicle with a depth camera to the front, which shows a wall 4 m ahead.
CompanionSetup with_depth_camera() {
  CompanionSetup setup = on_stand(AutopilotMake::ardupilot);
  setup.needs.cameras = {{"depth", CameraNeed::Channel::depth}};
  avoidance::MountedCamera camera{.role = "depth", .rate_hz = 20.0};
  camera.model = vision::camera::PinholeCamera::from_fov(64, 48, std::numbers::pi / 2.0);
  camera.X_BC.linear() << 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0;
  setup.module.cameras = {camera};
  setup.module.limits = {.speed_mps = 3.0, .acceleration_mps2 = 2.0, .radius_m = 0.5};
  return setup;
}

TEST(Companion, SendsUnknownSectorsBeforeTheFlightAndTheWallInIt) {
  Pair pair({}, with_depth_camera());
  pair.run_for(1.0);
  const auto first = pair.sent[ObstacleDistance::kId].at(0).as<ObstacleDistance>();
  EXPECT_EQ(pair.sent[ObstacleDistance::kId].size(), 10u);
  EXPECT_EQ(std::ranges::count(first->distances, 65535), 72);
  EXPECT_EQ(first->min_distance, 30);
  EXPECT_EQ(first->max_distance, 2000);
  EXPECT_EQ(pair.sent[DistanceSensor::kId].at(0).as<DistanceSensor>()->current_distance, 0);
  EXPECT_TRUE(pair.sent[VisionPositionEstimate::kId].empty()) << "there is no estimate";

  avoidance::NavigationState navigation;
  navigation.p_WB_est = Eigen::Vector3d(6.0, -3.0, -8.0);
  navigation.height_above_ground_m = 8.0;
  const std::vector<avoidance::CameraFrame> frames = {{"depth", 0, cv::Mat(48, 64, CV_32FC1, cv::Scalar(4.0))}};
  pair.companion.observe(pair.t_ns, {.t_ns = 0, .frames = frames, .navigation = navigation});
  pair.sent.clear();
  for (int i = 0; i < 100; ++i) pair.step(&navigation);

  const auto seen = pair.sent[ObstacleDistance::kId].at(0).as<ObstacleDistance>();
  EXPECT_NEAR(seen->distances[0], 400, 1);
  EXPECT_NEAR(seen->distances[6], 400 / std::cos(30.0 * std::numbers::pi / 180.0), 20)
      << "the wall 30 deg to the right";
  EXPECT_EQ(seen->distances[36], 65535);
  EXPECT_EQ(seen->time_usec, 1'000'000u);
  const auto old = pair.sent[ObstacleDistance::kId].back().as<ObstacleDistance>();
  EXPECT_EQ(std::ranges::count(old->distances, 65535), 72) << "half a second after the last image";
  EXPECT_EQ(pair.sent[DistanceSensor::kId].size(), 20u);
  EXPECT_EQ(pair.sent[DistanceSensor::kId].back().as<DistanceSensor>()->current_distance, 800);
  EXPECT_EQ(pair.sent[VisionPositionEstimate::kId].size(), 25u);
  EXPECT_EQ(pair.sent[VisionPositionEstimate::kId].back().as<VisionPositionEstimate>()->x, 1.0f) << "from the stand";
  EXPECT_EQ(pair.sent[Odometry::kId].size(), 25u);
  EXPECT_TRUE(pair.sent[OpticalFlow::kId].empty()) << "no camera looks down";
}

/// ArduPilot takes each of the two messages of optic flow for a reading of its own.
TEST(Companion, SendsTheFlowOfAnImageInOneMessage) {
  for (const AutopilotMake make : {AutopilotMake::ardupilot, AutopilotMake::px4}) {
    CompanionSetup setup = on_stand(make);
    setup.needs.cameras = {{"down", CameraNeed::Channel::grey}};
    avoidance::MountedCamera camera{.role = "down", .rate_hz = 20.0};
    camera.model = vision::camera::PinholeCamera::from_fov(160, 120, std::numbers::pi / 2.0);
    camera.X_BC.linear() << 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
    setup.module.cameras = {camera};
    Pair pair({}, setup);
    pair.run_for(1.0);
    pair.sent.clear();
    cv::Mat ground(140, 180, CV_8UC1);
    cv::RNG(7).fill(ground, cv::RNG::UNIFORM, 0, 256);
    cv::GaussianBlur(ground, ground, {7, 7}, 2.0);
    avoidance::NavigationState navigation;
    navigation.height_above_ground_m = 8.0;
    constexpr int kImages = 5;
    for (int i = 0; i < kImages; ++i) {
      const cv::Mat seen = ground(cv::Rect(10 - i, 10, 160, 120)).clone();
      const std::vector<avoidance::CameraFrame> frames = {{"down", 50'000'000 * i, seen}};
      pair.companion.observe(pair.t_ns, {.t_ns = 50'000'000 * i, .frames = frames, .navigation = navigation});
      pair.step(&navigation);
    }
    const size_t plain = pair.sent[OpticalFlow::kId].size(), integrated = pair.sent[OpticalFlowRad::kId].size();
    EXPECT_EQ(plain, make == AutopilotMake::ardupilot ? kImages - 1 : 0);
    EXPECT_EQ(integrated, make == AutopilotMake::px4 ? kImages - 1 : 0);
  }
}

TEST(Companion, SendsOnlyHeartbeatsToALineWithoutAutopilot) {
  Companion companion({}, with_depth_camera());
  size_t sent = 0;
  for (int64_t t_ns = 0; t_ns < 600 * kSecondNs; t_ns += 10 * kStepNs) {
    std::vector<uint8_t> bytes;
    companion.send(t_ns, nullptr, nullptr, bytes);
    sent += bytes.size();
  }
  EXPECT_EQ(sent, 600u * 21u) << "a heartbeat has 21 bytes";
}

TEST(Companion, RefusesAMaximumRangeBelowTheMinimum) {
  CompanionConfig config;
  config.perception.min_m = config.perception.max_m = 5.0;
  EXPECT_THROW(Companion(config, with_depth_camera()), std::invalid_argument);
}

}  // namespace
}  // namespace hedgehop::sim::mavlink
