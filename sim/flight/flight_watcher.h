#pragma once

#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string_view>

#include "avoidance/module.h"
#include "dynamics/rigid_body.h"
#include "dynamics/sensors/imu.h"

namespace hedgehop::sim {

/// What was measured on one tick, and what it was measured of.
struct SensorTick {
  int64_t t_ns = 0;
  dynamics::RigidBodyState body_true;
  std::optional<dynamics::sensors::ImuReading> imu;  ///< none on a tick without a reading
  dynamics::sensors::ImuReading imu_bias;            ///< what it is off by, noise and misalignment aside
  /// Of all cameras that expose on this tick, lost images left out; good until the next tick.
  std::span<const avoidance::CameraFrame> frames;
  /// What a camera sees on this tick as ImageChannel::depth, without imperfections.
  std::function<cv::Mat(std::string_view role)> depth;
  /// As ImageChannel::labels; and 255 where something that moves is seen, else 0.
  std::function<cv::Mat(std::string_view role)> labels, moving;
  /// As ImageChannel::flow, of the camera's last image that was not lost, to this tick. Throws std::logic_error at the
  /// first.
  std::function<cv::Mat(std::string_view role)> flow_to_here;
};

/// A flight at one instant, for people.
struct ShownInstant {
  int64_t t_ns = 0;
  cv::Mat annotated;                               ///< the module's image (CV_8UC3, RGB); empty where it draws none
  std::span<const avoidance::CameraFrame> frames;  ///< of all cameras, where it draws none
  std::string_view status;                         ///< of the last decision; empty before the first
  double obstacle_clearance_m = 0.0;               ///< true, of the hull; infinity where nothing is within range
};

/// Looks on while a flight is flown, for films, exports and progress; what it does cannot reach the flight.
class FlightWatcher {
 public:
  virtual ~FlightWatcher() = default;

  /// Images a second it wants, 0 for none.
  virtual double image_rate_hz() const { return 0.0; }
  virtual void on_images(const ShownInstant& /*shown*/) {}
  /// Whether it wants on_sensors(). Then every camera of the rig exposes at its rate, whoever else needs it.
  virtual bool wants_sensors() const { return false; }
  /// On every tick on which the IMU or a camera measured something.
  virtual void on_sensors(const SensorTick& /*tick*/) {}
  /// After every second of flight. @param goal_distance_m horizontal, NaN without a goal.
  virtual void on_progress(double /*t_s*/, double /*duration_s*/, double /*goal_distance_m*/) {}
};

}  // namespace hedgehop::sim
