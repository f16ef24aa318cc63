#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "avoidance/module.h"
#include "sim/mavlink/command_messages.h"
#include "sim/mavlink/frame.h"

namespace hedgehop::sim::mavlink {

/// Throws std::invalid_argument if the module declares attitude commands, which no link can send.
void require_steerable(const avoidance::Needs& needs);
/// Throws std::invalid_argument for an AttitudeCommand: autopilots accept no attitude together with an altitude.
void require_steerable(const avoidance::Command& command);

/// Returns a module's command as a setpoint, without time and receiver. An altitude becomes a vertical speed: the error
/// of the altitude per second, at most 2 m/s, so that a stale setpoint does not hold the vehicle at a wrong altitude.
/// @param navigation  the present estimate. @param p_origin_W  origin of the autopilot's local frame in W, m.
/// Throws as require_steerable().
SetPositionTargetLocalNed to_setpoint(const avoidance::Command& command, const avoidance::NavigationState& navigation,
                                      const Eigen::Vector3d& p_origin_W);

/// Sends a module's commands to an autopilot that flies by setpoints: ArduPilot in GUIDED, PX4 in OFFBOARD mode.
class Steering {
 public:
  /// @param autopilot  receiver. @param p_origin_W  origin of its local frame in W, m.
  Steering(Sender autopilot, const Eigen::Vector3d& p_origin_W) : autopilot_(autopilot), p_origin_W_(p_origin_W) {}

  /// Appends the setpoint of the command in effect: at once if the command is new, else each kRepeatNs.
  /// @param t_ns  time of the autopilot, rising. Throws as to_setpoint().
  void send(int64_t t_ns, const avoidance::Command& command, const avoidance::NavigationState& navigation,
            FrameWriter& writer, std::vector<uint8_t>& bytes);

  /// PX4 leaves OFFBOARD mode if setpoints arrive at 2 Hz or less; ArduPilot stops after 3 s without one.
  static constexpr int64_t kRepeatNs = 200'000'000;

 private:
  Sender autopilot_;
  Eigen::Vector3d p_origin_W_;
  std::optional<avoidance::Command> last_;
  int64_t sent_ns_ = 0;
};

}  // namespace hedgehop::sim::mavlink
