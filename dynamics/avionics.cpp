#include "dynamics/avionics.h"

#include <cmath>
#include <limits>

#include "sim/fields/bounds.h"

namespace hedgehop::dynamics {

Avionics::Avionics(const AvionicsConfig& config, const VehicleConfig& vehicle, double physics_dt_s,
                   const StreamSeed& stream_seed)
    : config_(fields::require_bounds(config)),
      physics_dt_s_(physics_dt_s),
      beam_direction_B_(sensors::beam_direction_B(config.range_finder)),
      seeds_{stream_seed("imu"),
             stream_seed("gps"),
             stream_seed("height_sensor"),
             stream_seed("magnetometer"),
             stream_seed("alignment"),
             config.barometer.enabled ? stream_seed("barometer") : 0,
             config.range_finder.ranger.enabled ? stream_seed("range_finder") : 0},
      imu_(config.imu, physics_dt_s, seeds_.imu),
      gps_(config.gps, physics_dt_s, seeds_.gps),
      height_sensor_("height_sensor", config.height_sensor.ranger, physics_dt_s, seeds_.height_sensor),
      magnetometer_(config.magnetometer, physics_dt_s, seeds_.magnetometer),
      navigation_(config.navigation,
                  {config.imu, config.gps, config.height_sensor, config.magnetometer, config.barometer}),
      autopilot_(config.autopilot, vehicle) {
  reset_options();
}

/// What need not be on board.
void Avionics::reset_options() {
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
  reset_options();

  // Alignment before take-off: attitude and position known with errors, inertial biases mostly taken away.
  sensors::NormalStream noise(seeds_.alignment);
  const control::NavigationConfig& c = config_.navigation;
  RigidBodyState known = truth.body;
  const Eigen::Vector3d tilt = c.attitude_sigma_rad * noise.draw3();
  known.q_WB = truth.body.q_WB * Eigen::Quaterniond(Eigen::AngleAxisd(tilt.norm(), tilt.stableNormalized()));
  known.p_WB += c.position_sigma_m * noise.draw3();
  sensors::ImuReading bias = imu_.bias();
  bias.w_WB_B_meas *= 1.0 - c.alignment_residual;
  bias.specific_force_B_meas *= 1.0 - c.alignment_residual;
  navigation_.reset(known, bias);
  autopilot_.reset(navigation_.estimate());
}

void Avionics::sense(int64_t t_ns, const SensedTruth& truth) {
  const int64_t tick = std::llround(static_cast<double>(t_ns) * 1e-9 / physics_dt_s_);
  const RigidBodyState& body = truth.body;
  imu_.observe(body.w_WB_B, truth.specific_force_B);
  gps_.observe(body.p_WB, body.q_WB * body.v_WB_B);
  const auto due = [tick](int64_t period) { return tick % period == 0; };

  imu_reading_.reset();
  if (due(imu_.period())) navigation_.predict(imu_reading_.emplace(imu_.read()));
  if (height_sensor_.observes(tick)) {
    height_sensor_.observe(
        sensors::nearest_echo_m(config_.height_sensor, truth.height_above_surface_m, truth.height_beside));
  }
  if (height_sensor_.due(tick)) {
    if (const std::optional<double> height_m = height_sensor_.read()) navigation_.correct_height(*height_m);
  }
  if (barometer_) {
    barometer_->observe(-body.p_WB.z());
    const std::optional<double> pressure_pa = due(barometer_->period()) ? barometer_->read() : std::nullopt;
    if (pressure_pa) navigation_.correct_pressure(*pressure_pa);
  }
  if (due(magnetometer_.period())) {
    const std::optional<double> heading_rad = magnetometer_.read(to_roll_pitch_heading(body.q_WB)[2]);
    if (heading_rad) navigation_.correct_heading(*heading_rad);
  }
  if (due(gps_.period())) {
    if (const std::optional<sensors::GpsFix> fix = gps_.read()) navigation_.correct_gps(*fix);
  }
  if (range_finder_) sense_range(tick, truth);
}

/// Casts the beam only on the ticks on which a reading begins.
void Avionics::sense_range(int64_t tick, const SensedTruth& truth) {
  if (range_finder_->observes(tick)) {
    const RigidBodyState& body = truth.body;
    const Eigen::Vector3d from_W = body.p_WB + body.q_WB * config_.range_finder.p_BI_m;
    const double reach_m = config_.range_finder.ranger.max_m;
    range_finder_->observe(truth.beam_distance ? truth.beam_distance(from_W, body.q_WB * beam_direction_B_, reach_m)
                                               : std::numeric_limits<double>::infinity());
  }
  if (range_finder_->due(tick)) range_m_ = range_finder_->read();
}

}  // namespace hedgehop::dynamics
