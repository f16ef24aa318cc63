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

/// Passes to a flight's watcher what it wants, tick by tick.
class Onlooker {
 public:
  /// @param watcher  may be null: then nothing is handed over.
  Onlooker(FlightWatcher* watcher, const Ticks& ticks, Cameras& cameras, const Aircraft& aircraft);

  /// The readings of all sensors, if it wants them. @param body  the aircraft's motion on this tick.
  void hand_over_sensors(int64_t tick, const BodyMotion& body);
  /// Images and progress, where they are due.
  /// @param annotate  the module's own image, asked for where it is shown. @param status  of the last decision.
  /// @param goal_distance_m  horizontal. @param duration_s  of the longest flight.
  void show(int64_t tick, const std::function<cv::Mat()>& annotate, std::string_view status,
            double obstacle_clearance_m, double duration_s, std::optional<double> goal_distance_m);

 private:
  FlightWatcher* watcher_;
  const Ticks& ticks_;
  Cameras& cameras_;
  const Aircraft& aircraft_;
  int64_t image_period_ = 0;
  std::vector<std::optional<Cameras::Instant>> exposed_;  ///< when each camera took its last image
};

}  // namespace hedgehop::sim
