#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "sim/fields/field.h"

/// Messages that steer an autopilot, and its answers. Units are those of the wire. Source of all: [Mavlink2024] sec. on
/// common.xml and minimal.xml.
namespace hedgehop::sim::mavlink {

/// Presence and mode of a component, once per second.
struct Heartbeat {
  static constexpr uint32_t kId = 0;
  static constexpr std::string_view kName = "HEARTBEAT";

  uint32_t custom_mode = 0;     ///< ArduCopter: 4 is GUIDED; PX4: main mode << 16, 6 is OFFBOARD
  uint8_t type = 0;             ///< MAV_TYPE; 18: onboard controller
  uint8_t autopilot = 0;        ///< MAV_AUTOPILOT; 3: ArduPilot, 8: none, 12: PX4
  uint8_t base_mode = 0;        ///< MAV_MODE_FLAG; 128: armed
  uint8_t system_status = 0;    ///< MAV_STATE; 4: active
  uint8_t mavlink_version = 3;  ///< 3: MAVLink 2
};
template <class Visitor>
constexpr void list_fields(Visitor& v, fields::ConfigOf<Heartbeat> auto& m) {
  v("custom_mode", m.custom_mode);
  v("type", m.type);
  v("autopilot", m.autopilot);
  v("base_mode", m.base_mode);
  v("system_status", m.system_status);
  v("mavlink_version", m.mavlink_version);
}

/// Attitude as the autopilot estimates it.
struct Attitude {
  static constexpr uint32_t kId = 30;
  static constexpr std::string_view kName = "ATTITUDE";

  uint32_t time_boot_ms = 0;  ///< ms
  float roll = 0.0f;          ///< rad
  float pitch = 0.0f;         ///< rad
  float yaw = 0.0f;           ///< rad
  float rollspeed = 0.0f;     ///< rad/s
  float pitchspeed = 0.0f;
  float yawspeed = 0.0f;
};
template <class Visitor>
constexpr void list_fields(Visitor& v, fields::ConfigOf<Attitude> auto& m) {
  v("time_boot_ms", m.time_boot_ms);
  v("roll", m.roll);
  v("pitch", m.pitch);
  v("yaw", m.yaw);
  v("rollspeed", m.rollspeed);
  v("pitchspeed", m.pitchspeed);
  v("yawspeed", m.yawspeed);
}

/// Position as the autopilot estimates it, from its own origin.
struct LocalPositionNed {
  static constexpr uint32_t kId = 32;
  static constexpr std::string_view kName = "LOCAL_POSITION_NED";

  uint32_t time_boot_ms = 0;  ///< ms
  float x = 0.0f;             ///< north, m
  float y = 0.0f;             ///< east, m
  float z = 0.0f;             ///< down, m
  float vx = 0.0f;            ///< m/s
  float vy = 0.0f;
  float vz = 0.0f;
};
template <class Visitor>
constexpr void list_fields(Visitor& v, fields::ConfigOf<LocalPositionNed> auto& m) {
  v("time_boot_ms", m.time_boot_ms);
  v("x", m.x);
  v("y", m.y);
  v("z", m.z);
  v("vx", m.vx);
  v("vy", m.vy);
  v("vz", m.vz);
}

/// Channels of a remote control, µs; 0 and 65535 leave a channel as it is.
struct RcChannelsOverride {
  static constexpr uint32_t kId = 70;
  static constexpr std::string_view kName = "RC_CHANNELS_OVERRIDE";

  std::array<uint16_t, 8> channels{};  ///< chan1_raw to chan8_raw
  uint8_t target_system = 0;
  uint8_t target_component = 0;
};
template <class Visitor>
constexpr void list_fields(Visitor& v, fields::ConfigOf<RcChannelsOverride> auto& m) {
  v("chan1_raw", m.channels[0]);
  v("chan2_raw", m.channels[1]);
  v("chan3_raw", m.channels[2]);
  v("chan4_raw", m.channels[3]);
  v("chan5_raw", m.channels[4]);
  v("chan6_raw", m.channels[5]);
  v("chan7_raw", m.channels[6]);
  v("chan8_raw", m.channels[7]);
  v("target_system", m.target_system);
  v("target_component", m.target_component);
}

/// A command that the autopilot acknowledges.
struct CommandLong {
  static constexpr uint32_t kId = 76;
  static constexpr std::string_view kName = "COMMAND_LONG";

  std::array<float, 7> parameters{};  ///< param1 to param7
  uint16_t command = 0;               ///< MAV_CMD
  uint8_t target_system = 0;
  uint8_t target_component = 0;
  uint8_t confirmation = 0;
};
template <class Visitor>
constexpr void list_fields(Visitor& v, fields::ConfigOf<CommandLong> auto& m) {
  v("param1", m.parameters[0]);
  v("param2", m.parameters[1]);
  v("param3", m.parameters[2]);
  v("param4", m.parameters[3]);
  v("param5", m.parameters[4]);
  v("param6", m.parameters[5]);
  v("param7", m.parameters[6]);
  v("command", m.command);
  v("target_system", m.target_system);
  v("target_component", m.target_component);
  v("confirmation", m.confirmation);
}

/// The answer to a command.
struct CommandAck {
  static constexpr uint32_t kId = 77;
  static constexpr std::string_view kName = "COMMAND_ACK";

  uint16_t command = 0;  ///< MAV_CMD
  uint8_t result = 0;    ///< MAV_RESULT; 0: accepted
  uint8_t progress = 0;  ///< %
  int32_t result_param2 = 0;
  uint8_t target_system = 0;
  uint8_t target_component = 0;
};
template <class Visitor>
constexpr void list_fields(Visitor& v, fields::ConfigOf<CommandAck> auto& m) {
  v("command", m.command);
  v("result", m.result);
  v.extensions();
  v("progress", m.progress);
  v("result_param2", m.result_param2);
  v("target_system", m.target_system);
  v("target_component", m.target_component);
}

/// Setpoint in the autopilot's local frame.
struct SetPositionTargetLocalNed {
  static constexpr uint32_t kId = 84;
  static constexpr std::string_view kName = "SET_POSITION_TARGET_LOCAL_NED";

  uint32_t time_boot_ms = 0;  ///< ms
  float x = 0.0f;             ///< north, m
  float y = 0.0f;             ///< east, m
  float z = 0.0f;             ///< down, m
  float vx = 0.0f;            ///< m/s
  float vy = 0.0f;
  float vz = 0.0f;
  float afx = 0.0f;  ///< m/s^2
  float afy = 0.0f;
  float afz = 0.0f;
  float yaw = 0.0f;        ///< rad
  float yaw_rate = 0.0f;   ///< rad/s
  uint16_t type_mask = 0;  ///< a bit per field: ignored
  uint8_t target_system = 0;
  uint8_t target_component = 0;
  uint8_t coordinate_frame = 0;  ///< MAV_FRAME; 1: local, north-east-down
};
template <class Visitor>
constexpr void list_fields(Visitor& v, fields::ConfigOf<SetPositionTargetLocalNed> auto& m) {
  v("time_boot_ms", m.time_boot_ms);
  v("x", m.x);
  v("y", m.y);
  v("z", m.z);
  v("vx", m.vx);
  v("vy", m.vy);
  v("vz", m.vz);
  v("afx", m.afx);
  v("afy", m.afy);
  v("afz", m.afz);
  v("yaw", m.yaw);
  v("yaw_rate", m.yaw_rate);
  v("type_mask", m.type_mask);
  v("target_system", m.target_system);
  v("target_component", m.target_component);
  v("coordinate_frame", m.coordinate_frame);
}

/// State of ArduPilot's navigation filter ([Mavlink2024] sec. on ardupilotmega.xml).
struct EkfStatusReport {
  static constexpr uint32_t kId = 193;
  static constexpr std::string_view kName = "EKF_STATUS_REPORT";

  float velocity_variance = 0.0f;
  float pos_horiz_variance = 0.0f;
  float pos_vert_variance = 0.0f;
  float compass_variance = 0.0f;
  float terrain_alt_variance = 0.0f;
  uint16_t flags = 0;  ///< EKF_STATUS_FLAGS
  float airspeed_variance = 0.0f;
};
template <class Visitor>
constexpr void list_fields(Visitor& v, fields::ConfigOf<EkfStatusReport> auto& m) {
  v("velocity_variance", m.velocity_variance);
  v("pos_horiz_variance", m.pos_horiz_variance);
  v("pos_vert_variance", m.pos_vert_variance);
  v("compass_variance", m.compass_variance);
  v("terrain_alt_variance", m.terrain_alt_variance);
  v("flags", m.flags);
  v.extensions();
  v("airspeed_variance", m.airspeed_variance);
}

/// A line of text for the user.
struct StatusText {
  static constexpr uint32_t kId = 253;
  static constexpr std::string_view kName = "STATUSTEXT";

  uint8_t severity = 0;  ///< MAV_SEVERITY; 0 to 7, 0: emergency
  std::array<char, 50> text{};
  uint16_t id = 0;
  uint8_t chunk_seq = 0;
};
template <class Visitor>
constexpr void list_fields(Visitor& v, fields::ConfigOf<StatusText> auto& m) {
  v("severity", m.severity);
  v("text", m.text);
  v.extensions();
  v("id", m.id);
  v("chunk_seq", m.chunk_seq);
}

}  // namespace hedgehop::sim::mavlink
