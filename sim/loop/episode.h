#pragma once

#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string_view>

#include "avoidance/module.h"
#include "dynamics/imu.h"
#include "dynamics/rigid_body.h"
#include "sim/render/renderer.h"
#include "sim/scenario/scenario.h"
#include "sim/verdict/flight.h"

namespace hedgehop::sim {

/// What was measured on one tick, and what it was measured of.
struct SensorTick {
  int64_t t_ns = 0;
  dynamics::RigidBodyState body_true;
  std::optional<dynamics::ImuReading> imu;  ///< none on a tick without a reading
  dynamics::ImuReading imu_bias;            ///< what it is off by, noise and misalignment aside
  /// Of all cameras that expose on this tick, lost pictures left out; good until the next tick.
  std::span<const avoidance::CameraFrame> frames;
  /// What a camera sees on this tick as Channel::depth, without imperfections.
  std::function<cv::Mat(std::string_view role)> depth;
};

/// Looks on while a flight is flown, for films and progress; what it does cannot reach the flight.
class FlightWatcher {
 public:
  virtual ~FlightWatcher() = default;

  /// Pictures a second it wants, 0 for none.
  virtual double picture_rate_hz() const { return 0.0; }
  /// The module's annotated picture (CV_8UC3, RGB), or, where it draws none, all cameras at one instant.
  virtual void on_pictures(int64_t /*t_ns*/, std::span<const avoidance::CameraFrame> /*frames*/,
                           const cv::Mat& /*annotated*/) {}
  /// Whether it wants on_sensors(). Then every camera of the rig exposes at its rate, whoever else needs it.
  virtual bool wants_sensors() const { return false; }
  /// On every tick on which the IMU or a camera measured something.
  virtual void on_sensors(const SensorTick& /*tick*/) {}
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
