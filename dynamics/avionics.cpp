#include "dynamics/avionics.h"

#include <cmath>

namespace hedgehop::dynamics {

Avionics::Avionics(const AvionicsConfig& config, const VehicleConfig& vehicle, double physics_dt_s,
                   const StreamSeed& stream_seed)
    : config_(config),
      physics_dt_s_(physics_dt_s),
      seeds_{stream_seed("imu"),           stream_seed("gps"),
             stream_seed("height_sensor"), stream_seed("magnetometer"),
             stream_seed("alignment"),     config.barometer.enabled ? stream_seed("barometer") : 0},
      imu_(config.imu, physics_dt_s, seeds_.imu),
      gps_(config.gps, physics_dt_s, seeds_.gps),
      height_sensor_(config.height_sensor, physics_dt_s, seeds_.height_sensor),
      magnetometer_(config.magnetometer, physics_dt_s, seeds_.magnetometer),
      navigation_(config.navigation,
                  {config.imu, config.gps, config.height_sensor, config.magnetometer, config.barometer}),
      autopilot_(config.autopilot, vehicle) {
  reset_barometer();
}

void Avionics::reset_barometer() {
  if (config_.barometer.enabled) barometer_.emplace(config_.barometer, physics_dt_s_, seeds_.barometer);
}

void Avionics::reset(const SensedTruth& truth) {
  imu_ = Imu(config_.imu, physics_dt_s_, seeds_.imu);
  gps_ = Gps(config_.gps, physics_dt_s_, seeds_.gps);
  height_sensor_ = HeightSensor(config_.height_sensor, physics_dt_s_, seeds_.height_sensor);
  magnetometer_ = Magnetometer(config_.magnetometer, physics_dt_s_, seeds_.magnetometer);
  reset_barometer();

  // Alignment before take-off: attitude and position known with errors, inertial biases mostly taken away.
  NormalStream noise(seeds_.alignment);
  const NavigationConfig& c = config_.navigation;
  RigidBodyState known = truth.body;
  const Eigen::Vector3d tilt = c.attitude_sigma_rad * noise.draw3();
  known.q_WB = truth.body.q_WB * Eigen::Quaterniond(Eigen::AngleAxisd(tilt.norm(), tilt.stableNormalized()));
  known.p_WB += c.position_sigma_m * noise.draw3();
  ImuReading bias = imu_.bias();
  bias.w_WB_B_meas *= 1.0 - c.alignment_residual;
  bias.specific_force_B_meas *= 1.0 - c.alignment_residual;
  navigation_.reset(known, bias);
  autopilot_.reset(navigation_.estimate());
}

void Avionics::sense(int64_t t_ns, const SensedTruth& truth) {
  const int64_t tick = std::llround(static_cast<double>(t_ns) * 1e-9 / physics_dt_s_);
  const RigidBodyState& body = truth.body;
  imu_.feel(body.w_WB_B, truth.specific_force_B);
  gps_.feel(body.p_WB, body.q_WB * body.v_WB_B);
  const auto due = [tick](int64_t period) { return tick % period == 0; };

  if (due(imu_.period())) navigation_.predict(imu_.read());
  if (due(height_sensor_.period())) {
    const double echo_m = nearest_echo_m(config_.height_sensor, truth.height_above_surface_m, truth.height_beside);
    if (const std::optional<double> height_m = height_sensor_.read(echo_m)) {
      navigation_.correct_height(*height_m);
    }
  }
  if (barometer_ && due(barometer_->period())) {
    navigation_.correct_pressure(barometer_->read(-body.p_WB.z()));
  }
  if (due(magnetometer_.period())) {
    const double heading_rad = magnetometer_.read(to_roll_pitch_heading(body.q_WB)[2]);
    if (magnetometer_.enabled()) navigation_.correct_heading(heading_rad);
  }
  if (due(gps_.period())) {
    if (const std::optional<GpsFix> fix = gps_.read()) navigation_.correct_gps(*fix);
  }
}

}  // namespace hedgehop::dynamics
