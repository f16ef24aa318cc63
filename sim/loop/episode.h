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
#include "sim/loop/flight_environment.h"
#include "sim/loop/flight_log.h"
#include "sim/loop/map_log.h"
#include "sim/loop/module_pilot.h"
#include "sim/loop/outside_autopilot.h"
#include "sim/loop/stage_timer.h"
#include "sim/loop/steering.h"
#include "sim/loop/velocimeter.h"
#include "sim/loop/watcher_dispatch.h"
#include "sim/scenario/flight_parts.h"

namespace hedgehop::sim {

/// One flight, tick by tick, without checks and metrics of the verdict. A tick has two halves: begin_tick() measures
/// (clearances, cameras, sensors), complete_tick() decides and controls. Between calls the episode is between them.
class Episode {
 public:
  /// Starts the flight and measures at time 0.
  /// @param environment, parts  of the scenario; scenario and environment outlive the episode.
  /// @param watcher, map_observer  may be null. @param outside  of a scenario with a link, else null. It flies the
  /// vehicle from its stand to the start before time 0, and may end the flight there.
  /// Throws InputError for errors that only the assembled parts show: a module without its camera, a vehicle that
  /// cannot hover at its start.
  Episode(const Scenario& scenario, FlightEnvironment& environment, FlightParts parts, FlightWatcher* watcher = nullptr,
          MapObserver* map_observer = nullptr, OutsideAutopilot* outside = nullptr);
  Episode(const Episode&) = delete;  // its parts refer to each other
  Episode& operator=(const Episode&) = delete;

  /// Completes this tick, moves the vehicle and begins the next tick. If the flight ends there, that tick is completed
  /// too. A fault is an outcome, not an exception.
  /// @param command  replaces the module's decision, on any tick; null lets the module decide when a decision is due.
  /// Throws std::logic_error if the flight is over, std::invalid_argument for a command that is not finite, or a direct
  /// command that is not valid for the vehicle.
  void tick(const CallerCommand* command = nullptr);
  bool over() const { return end_.has_value(); }
  /// Whether a decision is due on this tick.
  bool decides() const { return observation_.has_value(); }

  double t_s() const { return ticks_.t_s(tick_); }
  /// Returns the input of a decision now; valid until the next tick.
  avoidance::Observation observation() const;
  const Proximity& proximity() const { return proximity_; }
  const Aircraft& aircraft() const { return aircraft_; }
  /// The vehicle's true motion, with its clearance.
  BodyMotion motion() const;
  Cameras& cameras() { return cameras_; }
  Cameras::Instant instant() const { return {ticks_.t_ns(tick_), motion()}; }

  /// Returns the record so far, with the module's own metrics only. While the flight goes on, the outcome is `timeout`.
  Flight flight() const;

 private:
  struct Ending {
    Outcome outcome;
    std::string cause;
  };

  // A linked flight before time 0, and its physics step.
  void take_off();
  bool at_start() const;
  OutsideInput outside_input();
  void move_outside();

  // The steps of a tick, in this order.
  void begin_tick();
  void measure_proximity();
  void expose_cameras();
  void read_sensors();
  void complete_tick(const CallerCommand* command);
  void decide();
  /// Calls the module; an exception ends the flight as a fault.
  void call_module(const std::function<void()>& call);
  /// Returns the module's image; empty if it draws none.
  cv::Mat annotate() const;
  void override_decision(const CallerCommand& command);
  void observe_map();
  void run_autopilot();
  std::optional<Ending> ending() const;
  std::optional<Ending> fault_of_state() const;
  std::optional<Ending> collision() const;
  /// Whether the vehicle collides now, by the scenario's `collision_of`.
  bool collides() const;
  void end(Ending reason);
  void move();
  std::optional<double> goal_distance_m() const;

  const Scenario& scenario_;
  const Ticks ticks_;
  FlightEnvironment& environment_;
  Aircraft aircraft_;
  Cameras cameras_;
  std::optional<Velocimeter> velocimeter_;
  ModulePilot pilot_;
  WatcherDispatch watcher_dispatch_;
  MapObserver* const map_observer_;
  OutsideAutopilot* const outside_;
  const int64_t control_period_;

  int64_t tick_ = 0;
  int64_t outside_step_ = 0;                               ///< physics steps of the link, from before the flight
  bool flying_ = false;                                    ///< whether a linked flight has started
  Eigen::Vector3d p_WB_wanted_ = Eigen::Vector3d::Zero();  ///< start of a linked flight
  avoidance::NavigationState navigation_;                  ///< of the last step of a linked flight
  Eigen::Vector3d p_WB_start_ = Eigen::Vector3d::Zero();
  Proximity proximity_;
  const avoidance::CameraFrame* ground_ = nullptr;     ///< the velocimeter's image of this tick
  std::optional<avoidance::Observation> observation_;  ///< of this tick, if a decision is due
  std::optional<avoidance::Decision> decision_made_;   ///< on this tick, of a linked flight
  bool overridden_ = false;                            ///< whether the last command came from the caller
  FlightLog log_;
  MapLog map_log_;
  StageTimer physics_, render_, velocimetry_, decision_;
  std::optional<Ending> end_;
};

}  // namespace hedgehop::sim
