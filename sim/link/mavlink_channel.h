#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/loop/message_channel.h"
#include "sim/mavlink/companion.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim::link {

/// The module of a flight as the companion computer of an autopilot, over MAVLink.
class MavlinkChannel : public MessageChannel {
 public:
  MavlinkChannel(const Scenario& scenario, mavlink::AutopilotMake make, const mavlink::CompanionConfig& config);

  /// Throws InputError if the module declares commands that cannot be sent, or if its cameras do not fit the config.
  void prepare(const avoidance::Needs& needs, const avoidance::Setup& setup) override;
  void receive(const OutsideInput& now, std::span<const uint8_t> bytes) override;
  void send(const OutsideInput& now, std::vector<uint8_t>& bytes) override;
  std::string awaited() const override;
  int64_t malformed() const override;

 private:
  int64_t t_ns(const OutsideInput& now) const;

  mavlink::CompanionConfig config_;
  mavlink::CompanionSetup setup_;  ///< without the module before prepare()
  int64_t physics_rate_hz_;
  std::optional<mavlink::Companion> companion_;  ///< after prepare()
};

}  // namespace hedgehop::sim::link
