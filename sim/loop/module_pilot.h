#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "avoidance/module.h"
#include "dynamics/avionics.h"
#include "dynamics/control/autopilot.h"
#include "dynamics/hull.h"
#include "sim/loop/cameras.h"
#include "sim/loop/route.h"
#include "sim/loop/steering.h"
#include "sim/loop/ticks.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// Runs the module in flight: selects its frames, schedules its decisions and delays its commands to the autopilot.
class ModulePilot {
 public:
  /// @param module  of the scenario; null for a foreign module, which is loaded. @param module_folder  as of
  /// make_module(). Throws InputError for a module that cannot be loaded or whose cameras the rig lacks.
  ModulePilot(const Scenario& scenario, const Ticks& ticks, Cameras& cameras, std::unique_ptr<avoidance::Module> module,
              const std::filesystem::path& module_folder);

  /// Starts a flight. @param hull  of the vehicle. @param hold  setpoint until the first command takes effect.
  /// Throws InputError if the module cannot be reset.
  void reset(const std::vector<dynamics::HullPart>& hull, const dynamics::control::Setpoint& hold);

  /// Whether one of the module's cameras exposes on this tick.
  bool exposes(int64_t tick) const;
  /// Exposes the module's cameras that are due. During the hold at the start, the module does not receive their frames.
  void expose(int64_t tick, const BodyMotion& body);
  /// Whether a decision is due on this tick, after expose(): with a new frame, or without one if the last frame is so
  /// old that the module counts as blind (avoidance/blind_stop.h).
  bool decides(int64_t tick) const;
  /// Returns the input of a decision: the frames of this tick, the aircraft's own estimate, the current waypoint. The
  /// frames are valid until the next expose().
  avoidance::Observation observe(int64_t tick, const avoidance::NavigationState& navigation);
  /// Returns the module's decision; the command takes effect after the latency. Exceptions of the module pass
  /// through.
  avoidance::Decision decide(int64_t tick, const avoidance::Observation& observation);
  /// Queues a command that replaces the module's decision. A speed above the limit is scaled down to the limit. Throws
  /// std::invalid_argument if it is not finite. @return the command as it will take effect.
  avoidance::Command override_decision(int64_t tick, avoidance::Command command);
  /// As above, for a direct command. Throws std::invalid_argument if it is not valid for the vehicle.
  void override_decision(int64_t tick, const DirectCommand& command);

  /// Returns the last command whose latency is over, as the aircraft follows it. @param tick  increasing.
  const Steering& steering(int64_t tick);

  /// Returns the command of the autopilot's last setpoint; null before the first.
  const avoidance::Command* command_in_effect() const { return command_ ? &*command_ : nullptr; }

  const avoidance::Module& module() const { return *module_; }
  const Route& route() const { return route_; }
  /// Returns the first camera that the module needs, if any; its map comes from this camera.
  std::optional<size_t> first_camera() const;
  /// Whether that camera delivers the scene's corners through walls.
  bool sees_through_walls() const;
  /// Returns the ground truth in the module's input (sim::truth_used()).
  const std::vector<std::string>& truth_used() const { return truth_used_; }
  double command_latency_s() const { return ticks_.t_s(latency_); }  ///< from a decision to its command's effect

 private:
  void queue_command(int64_t tick, CallerCommand command);

  /// A command before its latency is over.
  struct PendingCommand {
    int64_t tick = 0;
    CallerCommand command;
  };

  const Scenario& scenario_;
  const Ticks& ticks_;
  Cameras& cameras_;
  std::unique_ptr<avoidance::Module> module_;
  std::vector<size_t> module_cameras_;
  std::vector<std::string> truth_used_;
  int64_t first_decision_ = 0, decision_period_ = 0, latency_ = 0, blind_after_ = 0, last_seen_ = 0;  ///< ticks
  bool exposed_ = false;  ///< whether one of the module's cameras was due on this tick
  Route route_;
  std::vector<avoidance::CameraFrame> seen_;  ///< the module's frames of this tick
  std::deque<PendingCommand> pending_;
  std::optional<avoidance::Command> command_;
  Steering steering_;
};

/// Converts a module's command to a setpoint of the autopilot.
dynamics::control::Setpoint to_setpoint(const avoidance::Command& command);
/// Converts the navigation filter's estimate to a module's input.
avoidance::NavigationState to_navigation_state(const dynamics::Avionics& avionics);

/// Lists the ground truth in a module's input: "camera 'left': depth", "camera 'front': projected corners",
/// "sensor 'gps': exact", "sensor 'imu': exact gyros". An instrument is exact if all its noise, offsets, wander and
/// misalignment are 0; latency, low rates and outages do not matter. Noise-free images and exact calibrations do not
/// count as ground truth.
/// @param needs  of the module. @param avionics  with the sensors of its navigation.
std::vector<std::string> truth_used(const avoidance::Needs& needs, const dynamics::AvionicsConfig& avionics);

}  // namespace hedgehop::sim
