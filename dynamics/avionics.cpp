#include "dynamics/avionics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/fields/bounds.h"

namespace hedgehop::dynamics {
namespace {

using sensors::Instrument;

constexpr double kSurveyedHeadingSigmaRad = 0.017453292519943295;  // 1 deg: chosen, the accuracy of a typical compass

}  // namespace

Avionics::Avionics(const AvionicsConfig& config, const VehicleConfig& vehicle, double physics_dt_s,
                   const StreamSeeds& stream_seeds, const std::vector<sensors::SensorFailure>& failures)
    : config_(fields::require_bounds(config)),
      physics_dt_s_(physics_dt_s),
      beam_direction_B_(sensors::beam_direction_B(config.range_finder)),
      seeds_{stream_seeds("imu"),
             stream_seeds("gps"),
             stream_seeds("height_sensor"),
             stream_seeds("magnetometer"),
             stream_seeds("survey"),
             config.barometer.enabled ? stream_seeds("barometer") : 0,
             config.range_finder.ranger.enabled ? stream_seeds("range_finder") : 0},
      imu_(config.imu, physics_dt_s, seeds_.imu),
      gps_(config.gps, physics_dt_s, seeds_.gps),
      height_sensor_("height_sensor", config.height_sensor.ranger, physics_dt_s, seeds_.height_sensor),
      magnetometer_(config.magnetometer, physics_dt_s, seeds_.magnetometer),
      failing_(failures),
      failures_(failures),
      navigation_(config.navigation,
                  {config.imu, config.gps, config.height_sensor, config.magnetometer, config.barometer}),
      autopilot_(config.autopilot, vehicle) {
  reset_optional_sensors();
}

void Avionics::reset_optional_sensors() {
  if (config_.barometer.enabled) barometer_.emplace(config_.barometer, physics_dt_s_, seeds_.barometer);
  const sensors::RangerConfig& beam = config_.range_finder.ranger;
  if (beam.enabled) range_finder_.emplace("range_finder", beam, physics_dt_s_, seeds_.range_finder);
  range_m_.reset();
}

void Avionics::reset(const SensedTruth& truth) {
  imu_ = sensors::Imu(config_.imu, physics_dt_s_, seeds_.imu);
  gps_ = sensors::Gps(config_.gps, physics_dt_s_, seeds_.gps);
  height_sensor_ = sensors::Ranger("height_sensor", config_.height_sensor.ranger, physics_dt_s_, seeds_.height_sensor);
  magnetometer_ = sensors::Magnetometer(config_.magnetometer, physics_dt_s_, seeds_.magnetometer);
  imu_reading_.reset();
  gps_fix_.reset();
  failures_ = sensors::SensorFailures(failing_);
  reset_optional_sensors();

  RandomStream survey(seeds_.survey);
  const Eigen::Vector3d p_WB_est = truth.body.p_WB + config_.navigation.position_sigma_m * sensors::normal3(survey);
  const double heading_rad = to_roll_pitch_heading(truth.body.q_WB)[2];
  const Eigen::Quaterniond q_on_ground(Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()));
  const control::Alignment on_ground = align(heading_rad, heading_rad + kSurveyedHeadingSigmaRad * survey.normal());
  navigation_.reset(on_ground.rotated(q_on_ground.conjugate() * truth.body.q_WB), p_WB_est);
  autopilot_.reset(navigation_.estimate());
  released_ = false;
  rate_control_.reset();
}

/// Reads the sensors at rest on level ground before take-off. Their random streams continue in the flight.
control::Alignment Avionics::align(double heading_rad, double surveyed_heading_rad) {
  control::GroundAlignment alignment(config_.imu, config_.magnetometer);
  imu_.observe(Eigen::Vector3d::Zero(), -kGravityMps2 * Eigen::Vector3d::UnitZ());
  const auto readings = [this](int64_t period) {
    return std::llround(control::kAlignmentS / (static_cast<double>(period) * physics_dt_s_));
  };
  const int64_t imu_count = std::max<int64_t>(1, readings(imu_.period())), headings = readings(magnetometer_.period());
  for (int64_t i = 0; i < imu_count; ++i) alignment.add(imu_.read());
  for (int64_t i = 0; i < headings; ++i) {
    const std::optional<double> read_rad = magnetometer_.read(heading_rad);
    if (read_rad) alignment.add_heading(*read_rad);
  }
  return alignment.result(surveyed_heading_rad, kSurveyedHeadingSigmaRad);
}

void Avionics::sense(int64_t t_ns, const SensedTruth& truth, const VelocitySensor& flow_velocity) {
  const int64_t tick = std::llround(static_cast<double>(t_ns) * 1e-9 / physics_dt_s_);
  const RigidBodyState& body = truth.body;
  imu_.observe(body.w_WB_B, truth.specific_force_B);
  gps_.observe(body.p_WB, body.q_WB * body.v_WB_B);
  const auto due = [tick](int64_t period) { return tick % period == 0; };

  imu_reading_.reset();
  if (due(imu_.period())) navigation_.predict(imu_reading_.emplace(read_imu(t_ns)));
  if (height_sensor_.observes(tick)) {
    height_sensor_.observe(
        sensors::nearest_echo_m(config_.height_sensor, truth.height_above_surface_m, truth.height_at_offset));
  }
  if (height_sensor_.due(tick)) {
    const std::optional<double> height_m = failures_.deliver(Instrument::height_sensor, t_ns, height_sensor_.read());
    if (height_m) navigation_.correct_height(*height_m);
  }
  if (barometer_) {
    barometer_->observe(-body.p_WB.z());
    if (due(barometer_->period())) {
      const std::optional<double> pressure_pa = failures_.deliver(Instrument::barometer, t_ns, barometer_->read());
      if (pressure_pa) navigation_.correct_pressure(*pressure_pa);
    }
  }
  if (due(magnetometer_.period())) {
    const std::optional<double> heading_rad =
        failures_.deliver(Instrument::magnetometer, t_ns, magnetometer_.read(to_roll_pitch_heading(body.q_WB)[2]));
    if (heading_rad) navigation_.correct_heading(*heading_rad);
  }
  gps_fix_.reset();
  if (due(gps_.period())) gps_fix_ = read_gps(t_ns);
  if (gps_fix_) navigation_.correct_gps(*gps_fix_);
  if (range_finder_) sense_beam(t_ns, tick, truth);
  if (!flow_velocity) return;
  if (const std::optional<VelocityReading> reading = flow_velocity(navigation_.estimate())) {
    const Eigen::Vector3d read(reading->v_WB_B_xy_meas.x(), reading->v_WB_B_xy_meas.y(), 0.0);
    const auto delivered = failures_.deliver(Instrument::velocimeter, t_ns, read);
    if (delivered) navigation_.correct_velocity(delivered->head<2>(), reading->sigma_mps);
  }
}

/// An IMU that is off reads 0, because the flight computer needs its readings.
sensors::ImuReading Avionics::read_imu(int64_t t_ns) {
  const sensors::ImuReading read = imu_.read();
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  return {failures_.deliver(Instrument::gyros, t_ns, read.w_WB_B_meas).value_or(zero),
          failures_.deliver(Instrument::accelerometers, t_ns, read.specific_force_B_meas).value_or(zero)};
}

std::optional<sensors::GpsFix> Avionics::read_gps(int64_t t_ns) {
  const std::optional<sensors::GpsFix> read = gps_.read();
  const auto p = failures_.deliver(Instrument::gps, t_ns, read ? std::optional(read->p_WB_W_meas) : std::nullopt);
  const auto v =
      failures_.deliver(Instrument::gps_velocity, t_ns, read ? std::optional(read->v_WB_W_meas) : std::nullopt);
  return p && v ? std::optional(sensors::GpsFix{*p, *v}) : std::nullopt;
}

Controls Avionics::control(const control::Setpoint& setpoint, double dt_s) {
  if (released_) autopilot_.reset(navigation_.estimate());
  released_ = false;
  rate_control_.reset();
  return autopilot_.control(setpoint, navigation_.estimate(), dt_s);
}

Controls Avionics::control(const control::RateSetpoint& setpoint, double dt_s) {
  if (!rate_control_) rate_control_.emplace(autopilot_.model(), dt_s);
  released_ = true;
  return rate_control_->control(setpoint, navigation_.estimate().w_WB_B_est);
}

void Avionics::release() {
  released_ = true;
  rate_control_.reset();
}

/// Casts the beam only on ticks on which a measurement starts.
void Avionics::sense_beam(int64_t t_ns, int64_t tick, const SensedTruth& truth) {
  if (range_finder_->observes(tick)) {
    const RigidBodyState& body = truth.body;
    const Eigen::Vector3d from_W = body.p_WB + body.q_WB * config_.range_finder.p_BI_m;
    const double reach_m = config_.range_finder.ranger.max_m;
    range_finder_->observe(truth.beam_distance ? truth.beam_distance(from_W, body.q_WB * beam_direction_B_, reach_m)
                                               : std::numeric_limits<double>::infinity());
  }
  if (range_finder_->due(tick)) range_m_ = failures_.deliver(Instrument::range_finder, t_ns, range_finder_->read());
}

}  // namespace hedgehop::dynamics
