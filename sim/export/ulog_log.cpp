#include "sim/export/ulog_log.h"

#include <optional>

#include "dynamics/rigid_body.h"
#include "sim/flight/build.h"
#include "sim/logfile/little_endian.h"
#include "sim/logfile/ulog_writer.h"

namespace hedgehop::sim {
namespace {

constexpr int64_t kNsPerUs = 1000;

/// Appends a vector as floats.
void append_floats(std::string& bytes, const Eigen::Vector3d& v) {
  for (const double value : v) append(bytes, static_cast<float>(value));
}

/// Returns the fields of a topic of PX4, vehicle_local_position.
std::string local_position(const Eigen::Vector3d& p_W, const Eigen::Vector3d& v_W, double heading_rad) {
  std::string bytes;
  append_floats(bytes, p_W);
  append_floats(bytes, v_W);
  append(bytes, static_cast<float>(heading_rad));
  return bytes;
}

/// Returns the fields of vehicle_attitude: w x y z of the rotation from B to W.
std::string attitude(const Eigen::Vector3d& rpy_rad) {
  const Eigen::Quaterniond q = dynamics::from_roll_pitch_heading(rpy_rad.x(), rpy_rad.y(), rpy_rad.z());
  std::string bytes;
  for (const double value : {q.w(), q.x(), q.y(), q.z()}) append(bytes, static_cast<float>(value));
  return bytes;
}

std::string doubles(const NamedNumbers& numbers) {
  std::string bytes;
  for (const auto& [name, value] : numbers) append(bytes, value);
  return bytes;
}

std::string double_fields(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += "double " + name + ";";
  return text;
}

class UlogLog : public LogSink {
 public:
  explicit UlogLog(const std::filesystem::path& file) : file_(file) {}

  bool wants_images() const override { return false; }

  void on_start(const LogStart& start) override {
    constexpr const char* kPosition = "float x;float y;float z;float vx;float vy;float vz;float heading;";
    ulog_.emplace(file_, 0);
    ulog_->add_information("sys_name", "Hedgehop");
    ulog_->add_information("ver_sw", std::string(version()));
    ulog_->add_information("scenario", start.scenario.name);
    ulog_->add_information("seed", std::to_string(start.scenario.seed));
    sensors_ = ulog_->add_topic("sensor_combined", "float[3] gyro_rad;float[3] accelerometer_m_s2;");
    gps_ = ulog_->add_topic("hedgehop_gps", "float[3] p_ned_m;float[3] v_ned_m_s;");
    position_ = ulog_->add_topic("vehicle_local_position", kPosition);
    true_position_ = ulog_->add_topic("vehicle_local_position_groundtruth", kPosition);
    attitude_ = ulog_->add_topic("vehicle_attitude", "float[4] q;");
    true_attitude_ = ulog_->add_topic("vehicle_attitude_groundtruth", "float[4] q;");
    state_ = ulog_->add_topic("hedgehop_state", double_fields(start.state_columns));
    decision_ = ulog_->add_topic("hedgehop_decision", double_fields(start.decision_columns));
  }

  /// IMU readings in B: R_FB() is its own inverse.
  void on_imu(int64_t t_ns, const RecordedReading& reading) override {
    std::string bytes;
    append_floats(bytes, R_FB() * reading.w_F);
    append_floats(bytes, R_FB() * reading.f_F);
    log(sensors_, t_ns, bytes);
  }

  void on_gps(int64_t t_ns, const dynamics::sensors::GpsFix& fix) override {
    std::string bytes;
    append_floats(bytes, fix.p_WB_W_meas);
    append_floats(bytes, fix.v_WB_W_meas);
    log(gps_, t_ns, bytes);
  }

  void on_state(int64_t t_ns, const LoggedState& state) override {
    const TrajectoryRow& row = state.row;
    log(position_, t_ns, local_position(row.p_WB_est, row.v_WB_W_est, row.rpy_est.z()));
    log(true_position_, t_ns, local_position(row.p_WB_true, row.v_WB_W_true, row.rpy_true.z()));
    log(attitude_, t_ns, attitude(row.rpy_est));
    log(true_attitude_, t_ns, attitude(row.rpy_true));
    log(state_, t_ns, doubles(state.columns));
  }

  void on_decision(int64_t t_ns, const LoggedDecision& decision) override {
    log(decision_, t_ns, doubles(decision.columns));
  }

  void on_event(int64_t t_ns, EventLevel level, const std::string& name, const std::string& message) override {
    constexpr UlogLevel kLevels[] = {UlogLevel::info, UlogLevel::warning, UlogLevel::error};
    ulog_->write_text(kLevels[static_cast<size_t>(level)], static_cast<uint64_t>(t_ns / kNsPerUs),
                      name + ": " + message);
  }

  void on_end(int64_t t_ns, const Flight& flight, const std::vector<std::pair<std::string, std::string>>&) override {
    on_event(t_ns, EventLevel::info, "trajectory_hash", flight.result.trajectory_hash);
    ulog_->close();
  }

 private:
  void log(uint16_t topic, int64_t t_ns, const std::string& fields) {
    ulog_->write(topic, static_cast<uint64_t>(t_ns / kNsPerUs), fields);
  }

  std::filesystem::path file_;
  std::optional<UlogWriter> ulog_;  ///< from the start of the flight
  uint16_t sensors_ = 0, gps_ = 0, position_ = 0, true_position_ = 0, attitude_ = 0, true_attitude_ = 0, state_ = 0,
           decision_ = 0;
};

}  // namespace

std::unique_ptr<LogSink> ulog_log(const std::filesystem::path& file) { return std::make_unique<UlogLog>(file); }

}  // namespace hedgehop::sim
