#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/scene.h"
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
#include "sim/loop/stage_timer.h"
#include "sim/loop/velocimeter.h"
#include "sim/scenario/flight_parts.h"

namespace hedgehop::sim {

/// One flight, tick by tick, unjudged. Flies once: either fly() or image().
class Episode {
 public:
  /// @param scenario  outlives the episode. @param parts  of the scenario. @param watcher, map_observer  may be null.
  /// Throws InputError for what only the assembled parts show: a scene that cannot be, a module without its camera.
  Episode(const Scenario& scenario, FlightParts parts, FlightWatcher* watcher = nullptr,
          MapObserver* map_observer = nullptr);
  Episode(const Episode&) = delete;  // its parts refer to each other
  Episode& operator=(const Episode&) = delete;

  /// Flies to the end. @return the record, with the module's own metrics and no judge's. Throws InputError for a
  /// vehicle that cannot hover at its start; a fault in flight is an outcome.
  Flight fly();
  /// Flies up to an instant and returns one camera's image of it. Throws InputError when the flight ends before.
  /// @param role  of a camera of the rig. @param t_s  >= 0.
  cv::Mat image(std::string_view role, Channel channel, double t_s);

  const std::vector<dynamics::HullPart>& hull() const { return hull_; }

 private:
  void begin();
  void act();  ///< all of a tick but the motion to the next

  // What happens on a tick, in this order.
  void measure_proximity();
  BodyMotion motion() const;
  void look();
  void sense();
  void decide();
  void observe_map();
  void steer();
  bool ended();
  void move();

  void end(Outcome outcome, std::string cause = {});
  std::optional<double> goal_distance_m() const;

  const Scenario& scenario_;
  const Ticks ticks_;
  const std::shared_ptr<const scenes::Scene> scene_;
  const std::vector<dynamics::HullPart> hull_;
  Aircraft aircraft_;
  CollisionWorld collision_;
  Cameras cameras_;
  std::optional<Velocimeter> velocimeter_;
  ModulePilot pilot_;
  Onlooker onlooker_;
  MapObserver* const map_observer_;
  const int64_t control_period_;

  int64_t tick_ = 0;
  Eigen::Vector3d p_WB_start_ = Eigen::Vector3d::Zero();
  Proximity proximity_;
  const avoidance::CameraFrame* ground_ = nullptr;  ///< the velocimeter's image of this tick
  FlightLog log_;
  MapLog map_log_;
  StageTimer physics_, render_, velocimetry_, decision_;
  std::optional<Outcome> outcome_;
  std::string cause_;
};

}  // namespace hedgehop::sim
