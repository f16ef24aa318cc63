#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "avoidance/module.h"
#include "dynamics/control/setpoint.h"
#include "dynamics/hull.h"
#include "sim/loop/cameras.h"
#include "sim/loop/route.h"
#include "sim/loop/ticks.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// The module in flight: which frames it gets, when it decides, and when its commands reach the autopilot.
class ModulePilot {
 public:
  /// @param module  of the scenario; null for one that is to be loaded from its shared library.
  /// Throws InputError for a module that cannot be loaded or does not get the cameras that it needs.
  ModulePilot(const Scenario& scenario, const Ticks& ticks, Cameras& cameras,
              std::unique_ptr<avoidance::Module> module);

  /// Starts a flight. @param hull  of the vehicle. @param hold  in effect until the first command is.
  /// Throws InputError where the module does not begin.
  void reset(const std::vector<dynamics::HullPart>& hull, const dynamics::control::Setpoint& hold);

  /// Whether one of its cameras exposes on this tick.
  bool looks(int64_t tick) const;
  /// Exposes those that do.
  void look(int64_t tick, const BodyMotion& body);
  /// Whether it decides on this tick, look() having been called: with a frame, and without one where there has been
  /// none for so long that it counts as blind (avoidance/blind_stop.h).
  bool decides(int64_t tick) const;
  /// What it would decide on now: its last frames, the aircraft's own estimate of this tick, the next place to fly to.
  /// The frames are good until the next look().
  avoidance::Observation observe(int64_t tick, const avoidance::NavigationState& navigation);
  /// Returns the module's decision; the command takes effect after the latency. Throws what the module throws.
  avoidance::Decision decide(int64_t tick, const avoidance::Observation& observation);
  /// Takes a command in place of the module's. Throws std::invalid_argument when it is not finite; a speed above the
  /// limit is scaled down to it. @return  as it will take effect.
  avoidance::Command obey(int64_t tick, avoidance::Command command);

  /// What the autopilot holds on this tick: the last command whose latency is over. @param tick  rising.
  const dynamics::control::Setpoint& setpoint(int64_t tick);

  const avoidance::Module& module() const { return *module_; }
  const Route& route() const { return route_; }
  /// The first camera it needs, if any: its map comes from this one.
  std::optional<size_t> first_camera() const;
  /// Whether that camera delivers the scene's corners through walls.
  bool sees_through_walls() const;
  /// What is true of all that it gets (truth_used.h).
  const std::vector<std::string>& truth_used() const { return truth_used_; }
  double command_latency_s() const { return ticks_.t_s(latency_); }  ///< from a decision to its command's effect

 private:
  void send(int64_t tick, const avoidance::Command& command);

  /// A command before its latency is over.
  struct PendingCommand {
    int64_t tick = 0;
    avoidance::Command command;
  };

  const Scenario& scenario_;
  const Ticks& ticks_;
  Cameras& cameras_;
  std::unique_ptr<avoidance::Module> module_;
  std::vector<size_t> module_cameras_;
  std::vector<std::string> truth_used_;
  int64_t decision_period_ = 0, latency_ = 0, blind_after_ = 0, last_seen_ = 0;  ///< ticks
  bool looked_ = false;  ///< whether one of its cameras was due on this tick
  Route route_;
  std::vector<avoidance::CameraFrame> seen_;  ///< the module's frames of this tick
  std::deque<PendingCommand> pending_;
  dynamics::control::Setpoint setpoint_;
};

}  // namespace hedgehop::sim
