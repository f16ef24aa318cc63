#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sim/export/log_cameras.h"
#include "sim/export/log_sink.h"
#include "sim/flight/flight_watcher.h"

namespace hedgehop::sim {

/// Passes a flight to a log while it is flown, in the frames E and F (sim/export/sensor_record.h).
class LogRecorder : public FlightWatcher {
 public:
  using Progress = std::function<void(double t_s, double duration_s, double goal_distance_m)>;

  /// @param scenario, sink, progress  outlive the recorder. @param roles  of the cameras; empty: all.
  /// @param truth  whether true depth is logged. @param folder  of the log, made when the flight starts. Throws
  /// InputError as logged_cameras().
  LogRecorder(const Scenario& scenario, const std::vector<std::string>& roles, bool truth, LogSink& sink,
              std::filesystem::path folder, const Progress& progress);

  /// Adds the events of the end and ends the log.
  void close(const Flight& flight);

  bool wants_sensors() const override { return true; }
  void on_start(const FlightStart& start) override;
  void on_sensors(const SensorTick& tick) override;
  void on_decision(const DecisionRow& row, const std::function<cv::Mat()>& annotate) override;
  void on_row(const TrajectoryRow& row) override;
  void on_progress(double t_s, double duration_s, double goal_distance_m) override {
    progress_(t_s, duration_s, goal_distance_m);
  }

 private:
  /// An event whose time is known before the flight.
  struct PlannedEvent {
    int64_t t_ns = 0;
    EventLevel level = EventLevel::info;
    std::string name, message;
  };

  LoggedMotion motion(const Eigen::Vector3d& p_WB, const Eigen::Quaterniond& q_WB, const Eigen::Vector3d& v_WB_B,
                      const Eigen::Vector3d& w_WB_B) const;
  void log_frame(const SensorTick& tick, const avoidance::CameraFrame& frame, const LoggedMotion& estimate);
  void log_planned_events(int64_t t_ns);

  const Scenario& scenario_;
  bool truth_;
  LogSink& sink_;
  std::filesystem::path folder_;
  const Progress& progress_;
  std::vector<LoggedCamera> cameras_;
  std::vector<PairDepth> pairs_;
  std::vector<PlannedEvent> planned_;  ///< in order of time
  size_t next_planned_ = 0;
  const scenes::Scene* scene_ = nullptr;
  Flight one_row_;  ///< names of signals and controls, and one row, for the columns of the tables
  dynamics::control::NavigationEstimate navigation_;  ///< of the last tick with sensors
  std::string last_status_;
  bool model_was_valid_ = true;
};

}  // namespace hedgehop::sim
