#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sim/mavlink/frame.h"

namespace hedgehop::sim::mavlink {

/// The makes of autopilots, as in MAV_AUTOPILOT.
enum class AutopilotMake : uint8_t { ardupilot = 3, px4 = 12 };

// MAV_CMD and MAV_MODE_FLAG.
inline constexpr uint16_t kTakeoff = 22, kSetMode = 176, kArm = 400, kSetMessageInterval = 511;
inline constexpr uint8_t kCustomMode = 1, kArmed = 128;

/// An autopilot as its messages describe it.
class AutopilotState {
 public:
  explicit AutopilotState(AutopilotMake make) : make_(make) {}

  /// Reads a message. The first autopilot of this make with a heartbeat is the peer; others are ignored.
  void take(const Frame& frame);

  const std::optional<Sender>& sender() const { return sender_; }
  uint32_t custom_mode() const { return custom_mode_; }
  bool armed() const { return armed_; }
  uint16_t filter_flags() const { return filter_flags_; }  ///< EKF_STATUS_FLAGS; 0 before the first report
  bool took_off() const { return took_off_; }              ///< accepted the command to take off
  const std::string& last_text() const { return last_text_; }
  /// Returns "protocol version 4 in HEARTBEAT; valid: 3" if the peer speaks another protocol, else an empty text.
  const std::string& fault() const { return fault_; }

 private:
  void take_heartbeat(const Frame& frame);

  AutopilotMake make_;
  std::optional<Sender> sender_;
  uint32_t custom_mode_ = 0;
  bool armed_ = false, took_off_ = false;
  uint16_t filter_flags_ = 0;
  std::string last_text_, fault_;
};

}  // namespace hedgehop::sim::mavlink
