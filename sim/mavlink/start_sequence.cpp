#include "sim/mavlink/start_sequence.h"

#include <algorithm>
#include <initializer_list>
#include <limits>

#include "sim/mavlink/command_messages.h"

namespace hedgehop::sim::mavlink {
namespace {

constexpr int64_t kRepeatNs = 1'000'000'000, kSetpointNs = 100'000'000;
constexpr uint32_t kGuided = 4, kOffboard = 6;
constexpr int64_t kRunUpNs = 20'000'000'000;  // H_RSC_RUNUP_TIME is 10 s by default
constexpr double kMinClimbM = 1.0;            // ArduPilot refuses to take off to the ground

/// Whether a message may be sent again; then it is.
bool is_due(std::optional<int64_t>& sent_ns, int64_t t_ns, int64_t period_ns) {
  if (sent_ns && t_ns - *sent_ns < period_ns) return false;
  sent_ns = t_ns;
  return true;
}

void append_command(uint16_t command, std::initializer_list<float> parameters, Sender target, FrameWriter& writer,
                    std::vector<uint8_t>& bytes) {
  CommandLong message{.command = command, .target_system = target.system, .target_component = target.component};
  std::ranges::copy(parameters, message.parameters.begin());
  writer.append(message, bytes);
}

/// Asks for the messages that the sequence needs, at 5 Hz.
void append_requests(Sender target, FrameWriter& writer, std::vector<uint8_t>& bytes) {
  constexpr float kPeriodUs = 200'000.0f;
  append_command(kSetMessageInterval, {static_cast<float>(EkfStatusReport::kId), kPeriodUs}, target, writer, bytes);
}

/// Sets channel 8, the motor interlock of a helicopter, and leaves the others.
void append_interlock(bool on, Sender target, FrameWriter& writer, std::vector<uint8_t>& bytes) {
  RcChannelsOverride message{.target_system = target.system, .target_component = target.component};
  message.channels.fill(std::numeric_limits<uint16_t>::max());
  message.channels[7] = on ? 2000 : 1000;
  writer.append(message, bytes);
}

bool filter_is_ready(uint16_t flags) {
  // EKF_STATUS_FLAGS: attitude, horizontal and vertical velocity, absolute horizontal and vertical position; not the
  // mode without position.
  constexpr uint16_t kNeeded = 1 | 2 | 4 | 16 | 32, kNoPosition = 128;
  return (flags & kNeeded) == kNeeded && (flags & kNoPosition) == 0;
}

void append_start_setpoint(int64_t t_ns, const StartPose& start, Sender target, FrameWriter& writer,
                           std::vector<uint8_t>& bytes) {
  const Eigen::Vector3f p = start.offset_m.cast<float>();
  constexpr uint16_t kPositionAndYaw = 0x09F8;
  constexpr uint8_t kLocalNed = 1;
  writer.append(SetPositionTargetLocalNed{.time_boot_ms = static_cast<uint32_t>(t_ns / 1'000'000),
                                          .x = p.x(),
                                          .y = p.y(),
                                          .z = p.z(),
                                          .yaw = static_cast<float>(start.heading_rad),
                                          .type_mask = kPositionAndYaw,
                                          .target_system = target.system,
                                          .target_component = target.component,
                                          .coordinate_frame = kLocalNed},
                bytes);
}

}  // namespace

void ArduPilotStart::advance(int64_t t_ns, const AutopilotState& autopilot) {
  const StartStep before = step_;
  const bool is_armed_step =
      step_ == StartStep::run_up || step_ == StartStep::take_off || (has_interlock_ && step_ == StartStep::mode);
  if (is_armed_step && !autopilot.armed()) step_ = StartStep::arm;  // it disarms if it waits too long
  if (step_ == StartStep::heartbeat && autopilot.sender()) step_ = StartStep::filter;
  if (step_ == StartStep::filter && filter_is_ready(autopilot.filter_flags())) {
    step_ = has_interlock_ ? StartStep::arm : StartStep::mode;
  }
  if (step_ == StartStep::mode && autopilot.custom_mode() == kGuided) {
    step_ = has_interlock_ ? StartStep::take_off : StartStep::arm;
  }
  if (step_ == StartStep::arm && autopilot.armed()) {
    step_ = has_interlock_ ? StartStep::run_up : StartStep::take_off;
    run_up_ns_ = t_ns;
  }
  if (step_ == StartStep::run_up && t_ns - *run_up_ns_ >= kRunUpNs) step_ = StartStep::mode;
  if (step_ == StartStep::take_off && autopilot.took_off()) step_ = StartStep::done;
  if (step_ != before) sent_ns_.reset();
}

void ArduPilotStart::send(int64_t t_ns, const AutopilotState& autopilot, FrameWriter& writer,
                          std::vector<uint8_t>& bytes) {
  advance(t_ns, autopilot);
  if (!autopilot.sender()) return;
  const Sender target = *autopilot.sender();
  if (has_interlock_ && step_ >= StartStep::mode && is_due(override_ns_, t_ns, kRepeatNs)) {
    append_interlock(step_ != StartStep::arm, target, writer, bytes);
  }
  if (step_ == StartStep::done || !is_due(sent_ns_, t_ns, kRepeatNs)) return;
  switch (step_) {
    case StartStep::filter:
      return append_requests(target, writer, bytes);
    case StartStep::mode:
      return append_command(kSetMode, {kCustomMode, static_cast<float>(kGuided)}, target, writer, bytes);
    case StartStep::arm:
      return append_command(kArm, {1.0f}, target, writer, bytes);
    case StartStep::take_off: {
      const auto climb_m = static_cast<float>(std::max(kMinClimbM, -start_.offset_m.z()));
      return append_command(kTakeoff, {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, climb_m}, target, writer, bytes);
    }
    default:
      return;
  }
}

void Px4Start::advance(int64_t t_ns, const AutopilotState& autopilot) {
  constexpr int64_t kStreamFirstNs = 1'000'000'000;  // PX4 accepts OFFBOARD only while setpoints arrive
  const StartStep before = step_;
  if (step_ == StartStep::heartbeat && autopilot.sender()) {
    step_ = StartStep::filter;
    streamed_ns_ = t_ns;
  }
  if (step_ == StartStep::filter && t_ns - *streamed_ns_ >= kStreamFirstNs) step_ = StartStep::mode;
  if (step_ == StartStep::mode && ((autopilot.custom_mode() >> 16) & 0xFF) == kOffboard) step_ = StartStep::arm;
  if (step_ == StartStep::arm && autopilot.armed()) step_ = StartStep::done;
  if (step_ != before) sent_ns_.reset();
}

void Px4Start::send(int64_t t_ns, const AutopilotState& autopilot, FrameWriter& writer, std::vector<uint8_t>& bytes) {
  advance(t_ns, autopilot);
  if (!autopilot.sender()) return;
  const Sender target = *autopilot.sender();
  if (is_due(setpoint_ns_, t_ns, kSetpointNs)) append_start_setpoint(t_ns, start_, target, writer, bytes);
  if (step_ != StartStep::mode && step_ != StartStep::arm) return;
  if (!is_due(sent_ns_, t_ns, kRepeatNs)) return;
  if (step_ == StartStep::mode) {
    append_command(kSetMode, {kCustomMode, static_cast<float>(kOffboard)}, target, writer, bytes);
  } else {
    append_command(kArm, {1.0f}, target, writer, bytes);
  }
}

std::string awaited(StartStep step, const AutopilotState& autopilot) {
  const std::string text = autopilot.last_text().empty() ? "" : " (its last message: " + autopilot.last_text() + ")";
  switch (step) {
    case StartStep::heartbeat:
      return "its HEARTBEAT";
    case StartStep::filter:
      return "its position estimate" + text;
    case StartStep::mode:
      return "its change of mode" + text;
    case StartStep::arm:
      return "its arming" + text;
    case StartStep::run_up:
      return "the run-up of its rotor" + text;
    case StartStep::take_off:
      return "its take-off" + text;
    case StartStep::done:
      return "its arrival at the start" + text;
  }
  return "";
}

}  // namespace hedgehop::sim::mavlink
