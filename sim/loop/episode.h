#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "sim/collision/proximity.h"
#include "sim/flight/flight.h"
#include "sim/flight/flight_watcher.h"
#include "sim/loop/aircraft.h"
#include "sim/loop/cameras.h"
#include "sim/loop/flight_log.h"
#include "sim/loop/map_log.h"
#include "sim/loop/map_observer.h"
#include "sim/loop/module_pilot.h"
#include "sim/loop/onlooker.h"
#include "sim/loop/stage.h"
#include "sim/loop/stage_timer.h"
#include "sim/loop/velocimeter.h"
#include "sim/scenario/flight_parts.h"

namespace hedgehop::sim {

/// One flight, tick by tick, unjudged. Flies once. On every tick the vehicle first arrives (its surroundings are
/// measured, cameras expose, sensors read), then acts: it stands between the two whenever no call is under way.
class Episode {
 public:
  /// Begins: arrives at time 0.
  /// @param scenario, stage  of one another; outlive the episode. @param parts  of the scenario.
  /// @param watcher, map_observer  may be null.
  /// Throws InputError for what only the assembled parts show: a module without its camera, a vehicle that cannot hover
  /// at its start.
  Episode(const Scenario& scenario, Stage& stage, FlightParts parts, FlightWatcher* watcher = nullptr,
          MapObserver* map_observer = nullptr);
  Episode(const Episode&) = delete;  // its parts refer to each other
  Episode& operator=(const Episode&) = delete;

  /// Acts, moves on by one tick and arrives; where that ends the flight, acts once more. A fault is an outcome.
  /// @param command  in place of the module's decision, on any tick; null where a module decides when it is due.
  /// Throws std::logic_error when the flight is over, std::invalid_argument for a command that is not finite.
  void tick(const avoidance::Command* command = nullptr);
  bool over() const { return end_.has_value(); }
  /// Whether a decision is due on this tick.
  bool decides() const { return observation_.has_value(); }

  double t_s() const { return ticks_.t_s(tick_); }
  /// What the module gets now, were it to decide; good until the next tick.
  avoidance::Observation observation() const;
  const Proximity& proximity() const { return proximity_; }
  const Aircraft& aircraft() const { return aircraft_; }
  /// The vehicle's true motion, with its clearance.
  BodyMotion motion() const;
  Cameras& cameras() { return cameras_; }
  Cameras::Instant instant() const { return {ticks_.t_ns(tick_), motion()}; }

  /// The record up to now, with the module's own metrics and no judge's; the outcome `timeout` where it is not over.
  Flight flight() const;

 private:
  struct Ending {
    Outcome outcome;
    std::string cause;
  };

  // What happens on a tick, in this order.
  void arrive();
  void measure_proximity();
  void look();
  void sense();
  void act(const avoidance::Command* command);
  void decide();
  /// Calls the module; what it throws ends the flight as a fault.
  void ask(const std::function<void()>& call);
  void obey(const avoidance::Command& command);
  void observe_map();
  void steer();
  std::optional<Ending> ending() const;
  void end(Ending reason);
  void move();
  std::optional<double> goal_distance_m() const;

  const Scenario& scenario_;
  const Ticks ticks_;
  Stage& stage_;
  Aircraft aircraft_;
  Cameras cameras_;
  std::optional<Velocimeter> velocimeter_;
  ModulePilot pilot_;
  Onlooker onlooker_;
  MapObserver* const map_observer_;
  const int64_t control_period_;

  int64_t tick_ = 0;
  Eigen::Vector3d p_WB_start_ = Eigen::Vector3d::Zero();
  Proximity proximity_;
  const avoidance::CameraFrame* ground_ = nullptr;     ///< the velocimeter's image of this tick
  std::optional<avoidance::Observation> observation_;  ///< of this tick, where a decision is due
  bool obeys_ = false;                                 ///< whether the last command came from outside
  FlightLog log_;
  MapLog map_log_;
  StageTimer physics_, render_, velocimetry_, decision_;
  std::optional<Ending> end_;
};

}  // namespace hedgehop::sim
