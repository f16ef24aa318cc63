#include "sim/export/log_recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/config/input_error.h"
#include "sim/flight/build.h"
#include "sim/flight/result_io.h"
#include "sim/flight/words.h"
#include "sim/record/flight_columns.h"

namespace hedgehop::sim {
namespace {

int64_t ns_of(double t_s) { return std::llround(t_s * 1e9); }

/// Returns the first number of each numeric column, without the time.
NamedNumbers first_numbers(const Table& table) {
  NamedNumbers numbers;
  for (const Table::Column& column : table.columns()) {
    const auto* const values = std::get_if<std::vector<double>>(&column.values);
    if (values && column.name != "t_s") numbers.emplace_back(column.name, values->empty() ? NAN : values->front());
  }
  return numbers;
}

std::vector<std::string> names_of(const NamedNumbers& numbers) {
  std::vector<std::string> names;
  for (const auto& [name, value] : numbers) names.push_back(name);
  return names;
}

/// Returns the result without wall times, so that equal flights give equal logs.
FlightResult without_wall_times(FlightResult result) {
  result.decision_ms = result.render_ms = result.velocimeter_ms = result.physics_ms = {};
  result.realtime_factor = result.wall_s = 0.0;
  std::erase_if(result.metrics, [](const MetricValue& metric) { return metric.kind == FigureKind::wall_time; });
  return result;
}

}  // namespace

LogRecorder::LogRecorder(const Scenario& scenario, const std::vector<std::string>& roles, bool truth, LogSink& sink,
                         std::filesystem::path folder, const Progress& progress)
    : scenario_(scenario),
      truth_(truth),
      sink_(sink),
      folder_(std::move(folder)),
      progress_(progress),
      cameras_(logged_cameras(scenario, roles)) {
  if (sink.wants_images()) pairs_ = stereo_pairs(scenario, cameras_);
  for (const FailureConfig& failure : scenario.failures) {
    const bool ends = failure.until_s.has_value();
    planned_.push_back({failure.from_ns(), EventLevel::warning, "failure", "begins: " + to_text(failure)});
    if (ends) planned_.push_back({failure.until_ns(), EventLevel::info, "failure", "ends: " + to_text(failure)});
  }
  std::ranges::stable_sort(planned_, {}, &PlannedEvent::t_ns);
}

void LogRecorder::on_start(const FlightStart& start) {
  scene_ = &start.scene;
  one_row_.signals.assign(start.signals.begin(), start.signals.end());
  std::ranges::copy(start.control_names, one_row_.control_names.begin());
  for (const NamedUnit& signal : one_row_.signals) {
    if (!is_topic_word(signal.name)) {
      throw InputError(
          fmt::format("signal '{}' of the module: a name in a log has letters, digits and underscores only, and starts "
                      "with no digit",
                      signal.name));
    }
  }
  std::filesystem::create_directories(folder_);
  sink_.on_start({scenario_, cameras_, start.scene, names_of(first_numbers(trajectory_columns(one_row_))),
                  names_of(first_numbers(decision_columns(one_row_)))});
}

LoggedMotion LogRecorder::motion(const Eigen::Vector3d& p_WB, const Eigen::Quaterniond& q_WB,
                                 const Eigen::Vector3d& v_WB_B, const Eigen::Vector3d& w_WB_B) const {
  const Eigen::Vector3d& p_BI = scenario_.avionics.imu.p_BI_m;
  Eigen::Isometry3d X_WI = Eigen::Isometry3d::Identity();
  X_WI.linear() = q_WB.toRotationMatrix();
  X_WI.translation() = p_WB + q_WB * p_BI;
  return {X_EF(X_WI), R_FB() * (v_WB_B + w_WB_B.cross(p_BI)), R_FB() * w_WB_B};
}

void LogRecorder::on_sensors(const SensorTick& tick) {
  navigation_ = tick.navigation;
  log_planned_events(tick.t_ns);
  if (tick.imu) {
    sink_.on_imu(tick.t_ns, {tick.t_ns, R_FB() * tick.imu->w_WB_B_meas, R_FB() * tick.imu->specific_force_B_meas});
  }
  if (tick.gps) sink_.on_gps(tick.t_ns, *tick.gps);
  if (!sink_.wants_images()) return;
  const LoggedMotion estimate =
      motion(navigation_.p_WB_est, navigation_.q_WB_est, navigation_.v_WB_B_est, navigation_.w_WB_B_est);
  for (const avoidance::CameraFrame& frame : tick.frames) log_frame(tick, frame, estimate);
  for (PairDepth& pair : pairs_) {
    const cv::Mat& depth_m = pair.match(tick.frames);
    if (!depth_m.empty()) sink_.on_depth(tick.t_ns, pair.left(), depth_m, estimate);
  }
}

void LogRecorder::log_frame(const SensorTick& tick, const avoidance::CameraFrame& frame, const LoggedMotion& estimate) {
  using Channel = CameraConfig::Channel;
  const auto found = std::ranges::find(cameras_, frame.role, &LoggedCamera::role);
  if (found == cameras_.end()) return;
  const auto camera = static_cast<size_t>(found - cameras_.begin());
  if (found->channel == Channel::corners) return sink_.on_corners(tick.t_ns, camera, frame.image);
  if (found->channel == Channel::depth) {
    sink_.on_depth(tick.t_ns, camera, frame.image, estimate);
  } else {
    sink_.on_image(tick.t_ns, camera, frame.image, estimate);
  }
  if (truth_) sink_.on_true_depth(tick.t_ns, camera, tick.depth(frame.role));
}

void LogRecorder::on_decision(const DecisionRow& row, const std::function<cv::Mat()>& annotate) {
  const int64_t t_ns = ns_of(row.t_s);
  one_row_.decisions.assign(1, row);
  sink_.on_decision(
      t_ns, {row.status, first_numbers(decision_columns(one_row_)), sink_.wants_images() ? annotate() : cv::Mat()});
  if (row.status == last_status_) return;
  last_status_ = row.status;
  sink_.on_event(t_ns, EventLevel::info, "module", "status: " + row.status);
}

void LogRecorder::on_row(const TrajectoryRow& row) {
  const int64_t t_ns = ns_of(row.t_s);
  log_planned_events(t_ns);
  one_row_.trajectory.assign(1, row);
  LoggedState state;
  const auto attitude = [](const Eigen::Vector3d& rpy) {
    return dynamics::from_roll_pitch_heading(rpy.x(), rpy.y(), rpy.z());
  };
  const Eigen::Quaterniond q_WB_true = attitude(row.rpy_true), q_WB_est = attitude(row.rpy_est);
  state.truth = motion(row.p_WB_true, q_WB_true, q_WB_true.conjugate() * row.v_WB_W_true, row.w_WB_B_true);
  state.estimate = motion(row.p_WB_est, q_WB_est, q_WB_est.conjugate() * row.v_WB_W_est, navigation_.w_WB_B_est);
  const dynamics::sensors::ImuConfig& imu = scenario_.avionics.imu;
  const double w_sigma_radps = imu.gyro_noise_density * std::sqrt(imu.rate_hz);
  // Standard deviations along W's axes, in the order of E; the velocity's along F as along W.
  state.sigmas = {(R_EW() * navigation_.sigma_p_W_m).cwiseAbs(), navigation_.sigma_attitude_B_rad,
                  navigation_.sigma_v_W_mps, Eigen::Vector3d::Constant(w_sigma_radps)};
  state.row = row;
  state.columns = first_numbers(trajectory_columns(one_row_));
  for (const scenes::Mover& mover : scene_->movers) {
    // The surfaces of a mover are logged about the axes of E, so its frame is turned on both sides.
    const Eigen::Isometry3d X_WM = scenes::X_WM(mover.motion, row.t_s);
    Eigen::Isometry3d& X_EM = state.X_EM.emplace_back(R_EW() * X_WM.linear() * R_EW().transpose());
    X_EM.translation() = R_EW() * X_WM.translation();
  }
  sink_.on_state(t_ns, state);
  if (row.model_valid == model_was_valid_) return;
  model_was_valid_ = row.model_valid;
  sink_.on_event(
      t_ns, row.model_valid ? EventLevel::info : EventLevel::warning, "vehicle",
      row.model_valid ? "rotors within the range of momentum theory" : "a rotor leaves the range of momentum theory");
}

void LogRecorder::log_planned_events(int64_t t_ns) {
  for (; next_planned_ < planned_.size() && planned_[next_planned_].t_ns <= t_ns; ++next_planned_) {
    const PlannedEvent& event = planned_[next_planned_];
    sink_.on_event(t_ns, event.level, event.name, event.message);
  }
}

void LogRecorder::close(const Flight& flight) {
  const FlightResult& result = flight.result;
  const int64_t t_ns = ns_of(result.flight_time_s);
  const bool bad = result.outcome == Outcome::collided || result.outcome == Outcome::fault;
  const std::string cause = result.cause.empty() ? "" : ": " + result.cause;
  sink_.on_event(t_ns, bad ? EventLevel::error : EventLevel::info, "flight",
                 std::string(to_string(result.outcome)) + cause);
  for (const CheckResult& check : result.checks) {
    sink_.on_event(t_ns, check.passed ? EventLevel::info : EventLevel::error, "check",
                   fmt::format("{} {}: {}", check.passed ? "pass" : "FAIL", check.name, check_words(check)));
  }
  const std::string scenario_yaml = to_yaml(scenario_);
  const RunInfo info{scenario_.name, scenario_.seed, std::string(version()), std::string(build_identity()), {}, "", "",
                     scenario_yaml};
  sink_.on_end(t_ns, flight,
               {{"scenario.yaml", scenario_yaml}, {"result.json", result_json(info, without_wall_times(result))}});
}

}  // namespace hedgehop::sim
