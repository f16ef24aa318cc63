#include "sim/mavlink/autopilot_state.h"

#include <algorithm>

#include "sim/mavlink/command_messages.h"

namespace hedgehop::sim::mavlink {

void AutopilotState::take(const Frame& frame) {
  if (frame.id == Heartbeat::kId) return take_heartbeat(frame);
  if (!sender_ || frame.sender.system != sender_->system) return;
  if (const auto report = frame.as<EkfStatusReport>()) filter_flags_ = report->flags;
  if (const auto text = frame.as<StatusText>()) {
    last_text_.assign(text->text.begin(), std::ranges::find(text->text, '\0'));
    std::ranges::replace_if(
        last_text_, [](char letter) { return letter < ' ' || letter > '~'; }, '?');
  }
  if (const auto ack = frame.as<CommandAck>(); ack && ack->command == kTakeoff && ack->result == 0) took_off_ = true;
}

void AutopilotState::take_heartbeat(const Frame& frame) {
  const Heartbeat message = *frame.as<Heartbeat>();
  if (message.autopilot != static_cast<uint8_t>(make_)) return;
  if (sender_ && (sender_->system != frame.sender.system || sender_->component != frame.sender.component)) return;
  constexpr uint8_t kVersion = 3;
  if (message.mavlink_version != kVersion) {
    fault_ = "protocol version " + std::to_string(message.mavlink_version) + " in HEARTBEAT; valid: 3";
    return;
  }
  sender_ = frame.sender;
  custom_mode_ = message.custom_mode;
  armed_ = (message.base_mode & kArmed) != 0;
}

}  // namespace hedgehop::sim::mavlink
