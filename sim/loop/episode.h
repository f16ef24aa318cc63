#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <string_view>

#include "avoidance/module.h"
#include "sim/loop/flight.h"
#include "sim/render/renderer.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// Looks on while a flight is flown, for films and progress; what it does cannot reach the flight.
class FlightWatcher {
 public:
  virtual ~FlightWatcher() = default;

  /// Pictures a second it wants, 0 for none.
  virtual double picture_rate_hz() const { return 0.0; }
  /// The module's annotated picture (CV_8UC3, RGB), or, where it draws none, all cameras at one instant.
  virtual void on_pictures(int64_t /*t_ns*/, std::span<const avoidance::CameraFrame> /*frames*/,
                           const cv::Mat& /*annotated*/) {}
  /// After every second of flight. @param goal_distance_m horizontal, NaN without a goal.
  virtual void on_progress(double /*t_s*/, double /*duration_s*/, double /*goal_distance_m*/) {}
};

/// Flies a scenario to its end. Equal scenarios give equal flights, bit for bit, the wall-time fields aside.
/// Throws InputError for what only the assembled parts can tell (a module without its camera, a vehicle that cannot
/// hover); a fault in flight is an outcome, not an exception.
Flight fly(const Scenario& scenario, FlightWatcher* watcher = nullptr);

/// What one camera of the rig sees in a flight, drawn as `channel` whatever the rig asks for.
/// @param role   of the camera; InputError names the rig's roles when it has no such camera.
/// @param t_s    time of the picture, >= 0; the flight is flown up to it, and for flow up to the camera's next picture.
///               InputError when it ends before.
cv::Mat picture_at(const Scenario& scenario, std::string_view role, Channel channel, double t_s);

}  // namespace hedgehop::sim
