#pragma once

#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "sim/flight/flight_watcher.h"
#include "sim/loop/aircraft.h"
#include "sim/loop/cameras.h"
#include "sim/loop/ticks.h"

namespace hedgehop::sim {

/// Passes sensor readings, images and progress to a flight's watcher, tick by tick.
class WatcherDispatch {
 public:
  /// @param watcher  may be null; then the calls have no effect.
  WatcherDispatch(FlightWatcher* watcher, const Ticks& ticks, Cameras& cameras, const Aircraft& aircraft);

  /// Passes the fixed properties of the flight. @param tables  of the flight.
  void send_start(const Flight& tables, const scenes::Scene& scene);
  /// Passes the last row of the trajectory.
  void send_row(const Flight& tables);
  /// Passes the last decision. @param annotate  makes the module's own image; called only if it is used.
  void send_decision(const Flight& tables, const std::function<cv::Mat()>& annotate);
  /// Passes the readings of all sensors if the watcher requests them. @param body  the aircraft's motion on this tick.
  void send_sensors(int64_t tick, const BodyMotion& body);
  /// Passes images and progress if they are due.
  /// @param annotate  makes the module's own image; called only if it is used. @param status  of the last decision.
  /// @param goal_distance_m  horizontal. @param duration_s  maximum flight time.
  void send_images(int64_t tick, const std::function<cv::Mat()>& annotate, std::string_view status,
                   double obstacle_clearance_m, double duration_s, std::optional<double> goal_distance_m);

 private:
  FlightWatcher* watcher_;
  const Ticks& ticks_;
  Cameras& cameras_;
  const Aircraft& aircraft_;
  int64_t image_period_ = 0;
  std::vector<std::optional<Cameras::Instant>> flow_starts_;  ///< of each camera
};

}  // namespace hedgehop::sim
