#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/mavlink/autopilot_state.h"
#include "sim/mavlink/frame.h"

/// Commands that bring an autopilot from its boot to the start of the flight. Time is that of the autopilot.
namespace hedgehop::sim::mavlink {

/// The steps. A helicopter arms and runs its rotor up in its boot mode, because ArduPilot keeps the rotor of a landed
/// helicopter at idle in GUIDED.
enum class StartStep { heartbeat, filter, mode, arm, run_up, take_off, done };

/// The start of a flight.
struct StartPose {
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();  ///< from the origin of the autopilot's local frame, axes of W
  double heading_rad = 0.0;
};

/// Starts ArduPilot: waits for its filter, selects GUIDED, arms and takes off to the altitude of the start. A step
/// repeats its command each second until the autopilot has done it.
class ArduPilotStart {
 public:
  /// @param has_interlock  a helicopter, whose motor interlock (channel 8) must be off to arm and on to fly.
  ArduPilotStart(const StartPose& start, bool has_interlock) : start_(start), has_interlock_(has_interlock) {}
  void send(int64_t t_ns, const AutopilotState& autopilot, FrameWriter& writer, std::vector<uint8_t>& bytes);
  StartStep step() const { return step_; }

 private:
  void advance(int64_t t_ns, const AutopilotState& autopilot);

  StartPose start_;
  bool has_interlock_;
  StartStep step_ = StartStep::heartbeat;
  std::optional<int64_t> sent_ns_, override_ns_, run_up_ns_;
};

/// Starts PX4: streams the start as a position setpoint, selects OFFBOARD and arms; the setpoint then takes it there.
class Px4Start {
 public:
  explicit Px4Start(const StartPose& start) : start_(start) {}
  void send(int64_t t_ns, const AutopilotState& autopilot, FrameWriter& writer, std::vector<uint8_t>& bytes);
  StartStep step() const { return step_; }

 private:
  void advance(int64_t t_ns, const AutopilotState& autopilot);

  StartPose start_;
  StartStep step_ = StartStep::heartbeat;
  std::optional<int64_t> sent_ns_, streamed_ns_, setpoint_ns_;
};

/// Returns the step's condition, for a message: "its HEARTBEAT".
std::string awaited(StartStep step, const AutopilotState& autopilot);

}  // namespace hedgehop::sim::mavlink
