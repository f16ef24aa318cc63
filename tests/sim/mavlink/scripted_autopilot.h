#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/mavlink/command_messages.h"
#include "sim/mavlink/frame.h"

namespace hedgehop::sim::mavlink {

/// An autopilot as far as its messages show it: it accepts a command only in the right state, as ArduPilot and PX4 do.
class ScriptedAutopilot {
 public:
  explicit ScriptedAutopilot(uint8_t make) : make_(make) {}

  int64_t filter_ready_ns = 20'000'000'000;  ///< its filter has a position from then on
  int refused_armings = 2;                   ///< number of requests to arm that it refuses
  bool refuses_take_off = false;
  uint8_t version = 3;

  uint32_t mode = 0;
  bool armed = false, took_off = false;
  float climb_m = 0.0f;
  std::vector<SetPositionTargetLocalNed> setpoints;
  std::vector<RcChannelsOverride> overrides;
  std::vector<int64_t> setpoint_times_ns;
  std::vector<uint16_t> commands;  ///< in the order received

  /// Reads the companion's bytes at a time, and returns its own.
  std::vector<uint8_t> exchange(int64_t t_ns, const std::vector<uint8_t>& bytes) {
    out_.clear();
    if (t_ns >= next_heartbeat_ns_) {
      next_heartbeat_ns_ += 1'000'000'000;
      writer_.append(Heartbeat{.custom_mode = mode,
                               .type = 2,
                               .autopilot = make_,
                               .base_mode = static_cast<uint8_t>(armed ? 129 : 1),
                               .mavlink_version = version},
                     out_);
      writer_.append(EkfStatusReport{.flags = static_cast<uint16_t>(t_ns >= filter_ready_ns ? 831 : 167)}, out_);
    }
    for (const Frame& frame : decoder_.decode(bytes)) take(t_ns, frame);
    return out_;
  }

 private:
  static constexpr uint8_t kPx4 = 12;
  static constexpr uint32_t kOffboardMode = 6u << 16;

  void take(int64_t t_ns, const Frame& frame) {
    if (const auto setpoint = frame.as<SetPositionTargetLocalNed>()) {
      setpoints.push_back(*setpoint);
      setpoint_times_ns.push_back(t_ns);
    }
    if (const auto channels = frame.as<RcChannelsOverride>()) overrides.push_back(*channels);
    if (const auto command = frame.as<CommandLong>()) {
      commands.push_back(command->command);
      writer_.append(CommandAck{.command = command->command, .result = obey(t_ns, *command)}, out_);
    }
  }

  uint8_t obey(int64_t t_ns, const CommandLong& command) {
    constexpr uint8_t kAccepted = 0, kDenied = 2;
    const auto parameter = [&](size_t i) { return command.parameters[i - 1]; };
    switch (command.command) {
      case 511:
        return kAccepted;
      case 176:
        if (parameter(1) != 1.0f) return kDenied;
        if (make_ == kPx4 && !streams(t_ns)) return refuse("no offboard signal", kDenied);
        mode = make_ == kPx4 ? static_cast<uint32_t>(parameter(2)) << 16 : static_cast<uint32_t>(parameter(2));
        return kAccepted;
      case 400:
        if (parameter(1) != 1.0f || (make_ == kPx4 && mode != kOffboardMode)) return kDenied;
        if (t_ns < filter_ready_ns || refused_armings-- > 0) return refuse("PreArm: Need Position Estimate", kDenied);
        armed = true;
        return kAccepted;
      case 22:
        if (!armed || refuses_take_off || make_ == kPx4) return kDenied;
        took_off = true;
        climb_m = parameter(7);
        return kAccepted;
      default:
        return kDenied;
    }
  }

  /// Whether setpoints arrived at more than 2 Hz for the last half second.
  bool streams(int64_t t_ns) const {
    return setpoint_times_ns.size() >= 3 && t_ns - setpoint_times_ns[setpoint_times_ns.size() - 3] <= 1'000'000'000;
  }

  uint8_t refuse(std::string_view reason, uint8_t result) {
    StatusText text{.severity = 2};
    std::ranges::copy(reason, text.text.begin());
    writer_.append(text, out_);
    return result;
  }

  uint8_t make_;
  FrameWriter writer_{{1, 1}};
  FrameDecoder decoder_;
  int64_t next_heartbeat_ns_ = 0;
  std::vector<uint8_t> out_;
};

}  // namespace hedgehop::sim::mavlink
