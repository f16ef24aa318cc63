#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>

#include "dynamics/sensors/gps.h"
#include "sim/export/sensor_record.h"
#include "sim/flight/flight_watcher.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// A camera in a log.
struct LoggedCamera {
  std::string role;
  int width_px = 0, height_px = 0;
  double rate_hz = 0.0;
  CameraConfig::Channel channel = CameraConfig::Channel::grey;
  vision::camera::Camera model;                            ///< as calibrated
  std::optional<Intrinsics> lens;                          ///< none for OCamCalib
  Eigen::Isometry3d X_FC = Eigen::Isometry3d::Identity();  ///< calibrated pose
  double pair_baseline_m = 0.0;  ///< > 0 for the right camera of a pair: distance to the left one
  bool has_depth = false;        ///< whether the log has depth images of this camera: measured or matched

  bool has_images() const { return channel == CameraConfig::Channel::grey || channel == CameraConfig::Channel::color; }
};

/// A motion of F in E, true or estimated.
struct LoggedMotion {
  Eigen::Isometry3d X_EF = Eigen::Isometry3d::Identity();
  Eigen::Vector3d v_EF_F = Eigen::Vector3d::Zero(), w_EF_F = Eigen::Vector3d::Zero();  ///< m/s, rad/s
};

/// Standard deviations of an estimated motion.
struct LoggedSigmas {
  Eigen::Vector3d p_E_m, attitude_F_rad, v_F_mps, w_F_radps;
};

using NamedNumbers = std::vector<std::pair<std::string, double>>;

/// One control tick.
struct LoggedState {
  LoggedMotion truth, estimate;
  LoggedSigmas sigmas;
  TrajectoryRow row;
  NamedNumbers columns;                 ///< of trajectory.csv, without the time
  std::vector<Eigen::Isometry3d> X_EM;  ///< poses of the movers
};

struct LoggedDecision {
  std::string status;
  NamedNumbers columns;  ///< of decisions.csv, without the time and the status
  cv::Mat image;         ///< the module's image (CV_8UC3, RGB); empty if it draws none
};

enum class EventLevel { info, warning, error };

/// The data of a log at the start of a flight.
struct LogStart {
  const Scenario& scenario;
  const std::vector<LoggedCamera>& cameras;  ///< of the log
  const scenes::Scene& scene;
  std::vector<std::string> state_columns, decision_columns;
};

/// Writes the log of a flight in one format. Times rise from call to call and start at 0. The functions throw
/// std::runtime_error if the file cannot be written.
class LogSink {
 public:
  virtual ~LogSink() = default;

  /// Whether on_image() and on_depth() are required.
  virtual bool wants_images() const { return true; }
  virtual void on_start(const LogStart& start) = 0;
  virtual void on_imu(int64_t /*t_ns*/, const RecordedReading& /*reading*/) {}
  /// @param fix  position and velocity of B in W.
  virtual void on_gps(int64_t /*t_ns*/, const dynamics::sensors::GpsFix& /*fix*/) {}
  /// @param camera  number of the camera. @param image  grey or RGB. @param estimate  at this time.
  virtual void on_image(int64_t /*t_ns*/, size_t /*camera*/, const cv::Mat& /*image*/,
                        const LoggedMotion& /*estimate*/) {}
  /// @param depth_m  CV_32FC1, z in C, m; of a fisheye the range; NaN if unknown. @param estimate  at this time.
  virtual void on_depth(int64_t /*t_ns*/, size_t /*camera*/, const cv::Mat& /*depth_m*/,
                        const LoggedMotion& /*estimate*/) {}
  /// @param depth_m  the same, true.
  virtual void on_true_depth(int64_t /*t_ns*/, size_t /*camera*/, const cv::Mat& /*depth_m*/) {}
  /// @param corners  N x 1, CV_64FC2, px.
  virtual void on_corners(int64_t /*t_ns*/, size_t /*camera*/, const cv::Mat& /*corners*/) {}
  virtual void on_decision(int64_t /*t_ns*/, const LoggedDecision& /*decision*/) {}
  virtual void on_state(int64_t /*t_ns*/, const LoggedState& /*state*/) {}
  virtual void on_event(int64_t /*t_ns*/, EventLevel /*level*/, const std::string& /*name*/,
                        const std::string& /*message*/) {}
  /// Ends the file. @param attachments  names and contents of files about the flight.
  virtual void on_end(int64_t t_ns, const Flight& flight,
                      const std::vector<std::pair<std::string, std::string>>& attachments) = 0;
};

}  // namespace hedgehop::sim
