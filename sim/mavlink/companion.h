#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "avoidance/module.h"
#include "sim/mavlink/autopilot_state.h"
#include "sim/mavlink/companion_config.h"
#include "sim/mavlink/frame.h"
#include "sim/mavlink/perception.h"
#include "sim/mavlink/start_sequence.h"
#include "sim/mavlink/steering.h"

namespace hedgehop::sim::mavlink {

/// The module and its aircraft, as a companion computer needs them.
struct CompanionSetup {
  AutopilotMake make = AutopilotMake::ardupilot;
  avoidance::Needs needs;
  avoidance::Setup module;
  Eigen::Vector3d p_origin_W = Eigen::Vector3d::Zero();  ///< origin of the autopilot's local frame: the stand, m
  Eigen::Vector3d p_start_W = Eigen::Vector3d::Zero();   ///< m
  double start_heading_rad = 0.0;
  bool has_interlock = false;  ///< of a helicopter's motor
};

/// The companion computer of an autopilot: it sends the module's perception and commands. Its output is a function of
/// its inputs and times.
class Companion {
 public:
  /// Throws std::invalid_argument "perception.max: ..." on a bad config, and if the module declares commands that
  /// cannot be sent.
  Companion(const CompanionConfig& config, CompanionSetup setup);

  /// Reads bytes of the autopilot, cut anywhere. Malformed bytes are counted.
  void receive(std::span<const uint8_t> bytes);
  /// Measures with the images of an observation of the module.
  void observe(int64_t t_ns, const avoidance::Observation& observation);
  /// Appends the messages that are due; before the autopilot's first heartbeat only heartbeats.
  /// @param t_ns  time of the autopilot, rising. @param navigation  null before the flight. @param command  the
  /// module's, null before its first. Throws std::invalid_argument for a command that cannot be sent.
  void send(int64_t t_ns, const avoidance::NavigationState* navigation, const avoidance::Command* command,
            std::vector<uint8_t>& bytes);

  const DecoderCounts& counts() const { return decoder_.counts(); }
  const AutopilotState& autopilot() const { return autopilot_; }
  /// Returns the condition for the start that is not yet met; empty if the companion does not steer.
  std::string awaited() const;
  /// Returns why the autopilot's messages cannot be used: "MAVLink 1; valid: MAVLink 2"; empty if they can.
  std::string fault() const;

 private:
  CompanionConfig config_;
  CompanionSetup setup_;
  FrameDecoder decoder_;
  FrameWriter writer_;
  AutopilotState autopilot_;
  Perception perception_;
  std::variant<ArduPilotStart, Px4Start> start_;
  std::optional<Steering> steering_;
  std::optional<int64_t> heartbeat_ns_;
};

}  // namespace hedgehop::sim::mavlink
