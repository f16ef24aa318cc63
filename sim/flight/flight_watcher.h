#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string_view>

#include "avoidance/module.h"
#include "dynamics/control/navigation.h"
#include "dynamics/rigid_body.h"
#include "dynamics/sensors/gps.h"
#include "dynamics/sensors/imu.h"
#include "sim/flight/flight.h"

namespace hedgehop::sim {

/// The measurements of one tick and the true state behind them.
struct SensorTick {
  int64_t t_ns = 0;
  dynamics::RigidBodyState body_true;
  std::optional<dynamics::sensors::ImuReading> imu;  ///< nullopt on a tick without a reading
  dynamics::sensors::ImuReading imu_bias;            ///< bias of the reading, without noise and misalignment
  std::optional<dynamics::sensors::GpsFix> gps;      ///< nullopt on a tick on which no fix arrives
  dynamics::control::NavigationEstimate navigation;  ///< of the onboard filter
  /// Frames of all cameras that expose on this tick, except lost images; valid until the next tick.
  std::span<const avoidance::CameraFrame> frames;
  /// Returns the view of a camera on this tick as ImageChannel::depth, without imperfections.
  std::function<cv::Mat(std::string_view role)> depth;
  /// As ImageChannel::labels and semantic; `moving` returns 255 for pixels of moving obstacles, otherwise 0.
  std::function<cv::Mat(std::string_view role)> labels, semantic, moving;
  /// Returns ImageChannel::flow of a camera from its last start_flow(), which is required, to this tick.
  std::function<cv::Mat(std::string_view role)> flow_to_here;
  /// Makes this tick the start of the camera's later flow_to_here().
  std::function<void(std::string_view role)> start_flow;
};

/// The properties of a flight that are fixed at its start.
struct FlightStart {
  std::span<const NamedUnit> signals;          ///< of DecisionRow::signals
  std::span<const std::string> control_names;  ///< of TrajectoryRow::controls, with units
  const scenes::Scene& scene;
};

/// A flight at one instant, for display.
struct ShownInstant {
  int64_t t_ns = 0;
  cv::Mat annotated;                               ///< the module's image (CV_8UC3, RGB); empty if it draws no image
  std::span<const avoidance::CameraFrame> frames;  ///< of all cameras, if the module draws no image
  std::string_view status;                         ///< of the last decision; empty before the first
  double obstacle_clearance_m = 0.0;               ///< true, of the hull; infinity if no obstacle is in range
};

/// Observes a flight, for videos, exports and progress. A watcher cannot influence the flight.
class FlightWatcher {
 public:
  virtual ~FlightWatcher() = default;

  /// Returns the required image rate; 0 for no images.
  virtual double image_rate_hz() const { return 0.0; }
  virtual void on_images(const ShownInstant& /*shown*/) {}
  /// Returns whether on_sensors() is required. If so, every camera of the rig exposes at its own rate.
  virtual bool wants_sensors() const { return false; }
  /// Called on every tick with a reading of the IMU, the GPS or a camera.
  virtual void on_sensors(const SensorTick& /*tick*/) {}
  /// Returns the working folder of a foreign module's process, with its log; empty: a temporary one.
  virtual std::filesystem::path module_folder() const { return {}; }
  /// Called at time 0 of a flight: in a linked flight after the take-off.
  virtual void on_start(const FlightStart& /*start*/) {}
  /// Called on every control tick, after on_sensors().
  virtual void on_row(const TrajectoryRow& /*row*/) {}
  /// Called after every decision. @param annotate  returns the module's image; empty if it draws none.
  virtual void on_decision(const DecisionRow& /*row*/, const std::function<cv::Mat()>& /*annotate*/) {}
  /// Called after every second of flight. @param goal_distance_m  horizontal; NaN without a goal.
  virtual void on_progress(double /*t_s*/, double /*duration_s*/, double /*goal_distance_m*/) {}
};

}  // namespace hedgehop::sim
