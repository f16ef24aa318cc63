#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sim/loop/outside_autopilot.h"

namespace hedgehop::sim {

/// Messages to and from an autopilot outside this process, in addition to its physics: the link moves the bytes, the
/// channel gives them a meaning. receive() is called once per physics step, in and before the flight, then send() if
/// the autopilot receives a state on that step.
class MessageChannel {
 public:
  virtual ~MessageChannel() = default;

  /// Takes the module's cameras and commands before the first step. Throws InputError if they do not fit the channel.
  virtual void prepare(const avoidance::Needs& /*needs*/, const avoidance::Setup& /*setup*/) {}

  /// Takes the bytes that arrived since the last call, in their order; there may be none. They are recorded with this
  /// step, so that a flight is a function of the scenario and the bytes received. Malformed bytes must be counted, not
  /// thrown.
  /// @param now  as in send().
  virtual void receive(const OutsideInput& now, std::span<const uint8_t> bytes) = 0;
  /// Appends the bytes to send before the autopilot receives this state. A std::invalid_argument ends the flight as a
  /// fault, with its message as the cause: a command that cannot be sent.
  /// @param now  the state after the last step, with the module's input, decision and command.
  virtual void send(const OutsideInput& now, std::vector<uint8_t>& bytes) = 0;

  /// Returns the condition for the start of the flight that is not yet met, for a message; may be empty.
  virtual std::string awaited() const { return ""; }
  /// Returns the number of malformed messages.
  virtual int64_t malformed() const { return 0; }
};

}  // namespace hedgehop::sim
