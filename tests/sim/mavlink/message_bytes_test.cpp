// Bytes of whole frames as pymavlink (ArduPilot/pymavlink b4c7ca29, dialects ardupilotmega and common) writes them;
// sequence numbers 0 to 10, time 1 s.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "sim/mavlink/command_messages.h"
#include "sim/mavlink/frame.h"
#include "sim/mavlink/hil_messages.h"
#include "sim/mavlink/perception_messages.h"
#include "tests/sim/mavlink/worked_bytes.h"

namespace hedgehop::sim::mavlink {
namespace {

constexpr uint64_t kTimeUs = 1'000'000;
constexpr uint32_t kTimeMs = 1000;
constexpr float kNanF = std::numeric_limits<float>::quiet_NaN();

/// Returns the frame of a message with a sequence number.
template <class Message>
std::vector<uint8_t> frame_of(const Message& message, int sequence, Sender sender) {
  FrameWriter writer(sender);
  std::vector<uint8_t> bytes;
  for (int i = 0; i <= sequence; ++i) {
    bytes.clear();
    writer.append(message, bytes);
  }
  return bytes;
}

constexpr Sender kCompanion{1, 196}, kSimulator{1, 200};

TEST(MessageBytes, HeartbeatIsAsPymavlinkWritesIt) {
  const Heartbeat message{
      .custom_mode = 0, .type = 18, .autopilot = 8, .base_mode = 0, .system_status = 4, .mavlink_version = 3};
  EXPECT_EQ(frame_of(message, 0, kCompanion), bytes_of("fd0900000001c4000000 00000000 12 08 00 04 03 f49a"));
}

TEST(MessageBytes, ObstacleDistanceIsAsPymavlinkWritesIt) {
  ObstacleDistance message{
      .time_usec = kTimeUs, .min_distance = 20, .max_distance = 2000, .sensor_type = 4, .increment = 5};
  message.distances.fill(2001);
  message.distances.front() = 500;
  message.distances.back() = 750;
  message.frame = 12;
  EXPECT_EQ(frame_of(message, 1, kCompanion),
            bytes_of("fda700000101c44a0100 40420f0000000000 f401 d107*70 ee02 1400 d007 04 05 00*8 0c 90a8"));
}

TEST(MessageBytes, DistanceSensorIsAsPymavlinkWritesItAndCutsZeros) {
  const DistanceSensor message{.time_boot_ms = kTimeMs,
                               .min_distance = 20,
                               .max_distance = 2000,
                               .current_distance = 523,
                               .type = 0,
                               .id = 1,
                               .orientation = 25,
                               .covariance = 4};
  EXPECT_EQ(frame_of(message, 2, kCompanion),
            bytes_of("fd0e00000201c4840000 e8030000 1400 d007 0b02 00 01 19 04 da9f"));
}

TEST(MessageBytes, VisionPositionEstimateIsAsPymavlinkWritesIt) {
  VisionPositionEstimate message{.usec = kTimeUs, .x = 1.5f, .y = -2.0f, .z = -10.0f, .roll = 0.0f, .pitch = 0.125f};
  message.yaw = 0.5f;
  message.covariance[0] = kNanF;
  EXPECT_EQ(frame_of(message, 3, kCompanion),
            bytes_of("fd2400000301c4660000 40420f0000000000 0000c03f 000000c0 000020c1 00*4 0000003e 0000003f 0000c07f "
                     "dc75"));
}

TEST(MessageBytes, OdometryIsAsPymavlinkWritesIt) {
  Odometry message{.time_usec = kTimeUs, .x = 1.5f, .y = -2.0f, .z = -10.0f, .q = {1.0f, 0.0f, 0.0f, 0.0f}};
  message.vx = 3.0f;
  message.vz = 0.25f;
  message.yawspeed = 0.125f;
  message.pose_covariance[0] = message.velocity_covariance[0] = kNanF;
  message.frame_id = 20;
  message.child_frame_id = 12;
  message.estimator_type = 3;
  message.quality = 100;
  EXPECT_EQ(
      frame_of(message, 4, kCompanion),
      bytes_of("fde900000401c44b0100 40420f0000000000 0000c03f 000000c0 000020c1 0000803f 00*12 00004040 00*4 0000803e "
               "00*8 0000003e 0000c07f 00*80 0000c07f 00*80 14 0c 00 03 64 4121"));
}

TEST(MessageBytes, OpticalFlowRadIsAsPymavlinkWritesIt) {
  const OpticalFlowRad message{.time_usec = kTimeUs,
                               .integration_time_us = 20'000,
                               .integrated_x = 1.0f / 64.0f,
                               .integrated_y = -1.0f / 32.0f,
                               .integrated_xgyro = 1.0f / 128.0f,
                               .time_delta_distance_us = 20'000,
                               .distance = 8.5f,
                               .temperature = 2000,
                               .quality = 255};
  EXPECT_EQ(
      frame_of(message, 5, kCompanion),
      bytes_of("fd2c00000501c46a0000 40420f0000000000 204e0000 0000803c 000000bd 0000003c 00*8 204e0000 00000841 d007 "
               "00 ff 6247"));
}

TEST(MessageBytes, SetPositionTargetIsAsPymavlinkWritesIt) {
  const SetPositionTargetLocalNed message{.time_boot_ms = kTimeMs,
                                          .vx = 3.0f,
                                          .vy = -1.0f,
                                          .vz = 0.25f,
                                          .yaw = 0.5f,
                                          .type_mask = 0x09C7,
                                          .target_system = 1,
                                          .target_component = 1,
                                          .coordinate_frame = 1};
  EXPECT_EQ(
      frame_of(message, 6, kCompanion),
      bytes_of(
          "fd3500000601c4540000 e8030000 00*12 00004040 000080bf 0000803e 00*12 0000003f 00*4 c709 01 01 01 6b9b"));
}

TEST(MessageBytes, HilSensorIsAsPymavlinkWritesIt) {
  HilSensor message{.time_usec = kTimeUs};
  const auto bytes = bytes_of(
      "fd3e00000701c86b0000 40420f0000000000 00*8 0ae81cc1 00*12 0000803e 00*4 0000003f 00507d44 00*8 00007041 ff1b "
      "ea27");
  message.zacc = -9.80665f;
  message.xmag = 0.25f;
  message.zmag = 0.5f;
  message.abs_pressure = 1013.25f;
  message.temperature = 15.0f;
  message.fields_updated = 0x1BFF;
  EXPECT_EQ(frame_of(message, 7, kSimulator), bytes);
}

TEST(MessageBytes, HilGpsIsAsPymavlinkWritesIt) {
  const HilGps message{.time_usec = kTimeUs,
                       .lat = 473977420,
                       .lon = 85455940,
                       .alt = 488000,
                       .eph = 100,
                       .epv = 100,
                       .vel = 300,
                       .vn = 300,
                       .ve = 0,
                       .vd = 0,
                       .cog = 0,
                       .fix_type = 3,
                       .satellites_visible = 10};
  EXPECT_EQ(
      frame_of(message, 8, kSimulator),
      bytes_of("fd2400000801c8710000 40420f0000000000 4c52401c 44f41705 40720700 6400 6400 2c01 2c01 00*6 030a 3849"));
}

TEST(MessageBytes, HilStateQuaternionIsAsPymavlinkWritesIt) {
  HilStateQuaternion message{.time_usec = kTimeUs, .attitude_quaternion = {1.0f, 0.0f, 0.0f, 0.0f}};
  message.lat = 473977420;
  message.lon = 85455940;
  message.alt = 488000;
  message.vx = 300;
  message.ind_airspeed = message.true_airspeed = 300;
  message.zacc = -1000;
  EXPECT_EQ(
      frame_of(message, 9, kSimulator),
      bytes_of("fd4000000901c8730000 40420f0000000000 0000803f 00*24 4c52401c 44f41705 40720700 2c01 00*4 2c01 2c01 "
               "00*4 18fc 90cc"));
}

TEST(MessageBytes, HilActuatorControlsIsAsPymavlinkWritesIt) {
  HilActuatorControls message{.time_usec = kTimeUs, .flags = 1, .controls = {0.5f, 0.5f, 0.5f, 0.5f}, .mode = 129};
  EXPECT_EQ(frame_of(message, 10, Sender{1, 1}),
            bytes_of("fd5100000a01015d0000 40420f0000000000 01 00*7 0000003f*4 00*48 81 3b0f"));
}

TEST(MessageBytes, AreReadBackAndCutFieldsAreZero) {
  FrameDecoder decoder;
  const auto frames = decoder.decode(bytes_of("fd0e00000201c4840000 e8030000 1400 d007 0b02 00 01 19 04 da9f"));
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].sender.component, 196);
  EXPECT_EQ(frames[0].sequence, 2);
  EXPECT_FALSE(frames[0].as<Heartbeat>());
  const auto message = frames[0].as<DistanceSensor>();
  ASSERT_TRUE(message);
  EXPECT_EQ(message->current_distance, 523);
  EXPECT_EQ(message->orientation, 25);
  EXPECT_EQ(message->horizontal_fov, 0.0f);
}

/// CRC_EXTRA as the generators of MAVLink print them for common.xml, minimal.xml and ardupilotmega.xml.
TEST(DefinitionChecksum, EqualsThatOfTheGenerators) {
  EXPECT_EQ(crc_extra<Heartbeat>(), 50);
  EXPECT_EQ(crc_extra<Attitude>(), 39);
  EXPECT_EQ(crc_extra<LocalPositionNed>(), 185);
  EXPECT_EQ(crc_extra<RcChannelsOverride>(), 124);
  EXPECT_EQ(crc_extra<CommandLong>(), 152);
  EXPECT_EQ(crc_extra<CommandAck>(), 143);
  EXPECT_EQ(crc_extra<SetPositionTargetLocalNed>(), 143);
  EXPECT_EQ(crc_extra<HilActuatorControls>(), 47);
  EXPECT_EQ(crc_extra<OpticalFlow>(), 175);
  EXPECT_EQ(crc_extra<VisionPositionEstimate>(), 158);
  EXPECT_EQ(crc_extra<OpticalFlowRad>(), 138);
  EXPECT_EQ(crc_extra<HilSensor>(), 108);
  EXPECT_EQ(crc_extra<HilGps>(), 124);
  EXPECT_EQ(crc_extra<HilStateQuaternion>(), 4);
  EXPECT_EQ(crc_extra<DistanceSensor>(), 85);
  EXPECT_EQ(crc_extra<EkfStatusReport>(), 71);
  EXPECT_EQ(crc_extra<StatusText>(), 83);
  EXPECT_EQ(crc_extra<ObstacleDistance>(), 23);
  EXPECT_EQ(crc_extra<Odometry>(), 91);
}

/// The check value of CRC-16/MCRF4XX.
TEST(Checksum, OfTheDigitsIsTheCheckValueOfTheAlgorithm) {
  Checksum sum;
  sum.add("123456789");
  EXPECT_EQ(sum.value(), 0x6F91);
}

}  // namespace
}  // namespace hedgehop::sim::mavlink
