#include "dynamics/control/navigation.h"

#include <algorithm>
#include <cmath>

#include "dynamics/air/atmosphere.h"
#include "sim/fields/bounds.h"
#include "sim/fields/quantities.h"

namespace hedgehop::dynamics::control {
namespace {

// Index of each part of the error state: attitude (small rotation in B), velocity and position in W, biases of gyros
// and accelerometers, wandering horizontal error of the satellite position, compass offset, wandering barometer error.
constexpr int kTheta = 0, kV = 3, kP = 6, kGyro = 9, kAccelerometer = 12, kWander = 15, kCompass = 17, kBarometer = 18;

constexpr double kInitialVelocitySigmaMps = 0.05;  // chosen: hover at the start
// Minimum errors that the filter assumes, chosen below those of real sensors: with exact ones, the errors of its own
// integration remain, such as those of the IMU's low-pass filter.
constexpr double kMinGyroDensity = 1e-5;           // rad/s/sqrt(Hz)
constexpr double kMinAccelerometerDensity = 1e-4;  // m/s^2/sqrt(Hz)
constexpr double kMinHeadingRad = 1e-4, kMinPositionM = 1e-3, kMinVelocityMps = 1e-3, kMinPressurePa = 0.05;
constexpr double kIllConditioned = 1e-6;  // variance of a reading over that of its innovation
constexpr double kGate = 9.0;             // squared ratio of innovation to sigma above which the weight falls
constexpr int kJumpReadings = 3;          // agreeing readings required to accept another surface
constexpr double kCoastAfterS = 1.0;      // time without a velocity or position, after which ...
constexpr double kCoastSigmaMps = 3.0;    // ... the speed is assumed below about this, once per second

Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

/// Returns the variance of an error that is at least `min_sigma`.
double variance_of(double sigma, double min_sigma) { return square(std::max(sigma, min_sigma)); }

Eigen::Quaterniond rotation(const Eigen::Vector3d& v) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(v.norm(), v.stableNormalized()));
}

}  // namespace

Navigation::Navigation(const NavigationConfig& config, const Sensors& sensors)
    : config_(fields::require_bounds(config, "navigation")), sensors_(sensors), dt_s_(1.0 / sensors.imu.rate_hz) {
  history_.resize(static_cast<size_t>(std::llround(sensors.gps.latency_s / dt_s_)) + 1);
  reset({}, Eigen::Vector3d::Zero());
}

void Navigation::reset(const Alignment& alignment, const Eigen::Vector3d& p_WB_est) {
  q_WB_ = q_WB_gyro_ = alignment.q_WB_est;
  v_WB_W_.setZero();
  p_WB_ = p_WB_est;
  w_WB_B_.setZero();
  gyro_bias_ = alignment.gyro_bias_est;
  accelerometer_bias_.setZero();
  gps_wander_m_.setZero();
  compass_offset_rad_ = 0.0;
  barometer_wander_pa_ = 0.0;
  last_imu_.reset();
  since_velocity_s_ = 0.0;
  surface_m_ = surface_sigma_m_ = 0.0;
  jump_count_ = 0;
  correction_.setZero();
  std::fill(history_.begin(), history_.end(), Past{p_WB_, v_WB_W_});
  next_ = 0;

  Column sigma = Column::Zero();
  sigma.segment<3>(kV).setConstant(kInitialVelocitySigmaMps);
  sigma.segment<3>(kP).setConstant(config_.position_sigma_m);
  sigma.segment<3>(kGyro).setConstant(alignment.gyro_bias_sigma_radps);
  sigma.segment<3>(kAccelerometer).setConstant(alignment.accelerometer_bias_sigma_mps2);
  sigma.segment<2>(kWander).setConstant(sensors_.gps.wander_horizontal_m);
  sigma[kCompass] = alignment.compass_sigma_rad;
  sigma[kBarometer] = sensors_.barometer.wander_pa;
  P_ = sigma.cwiseAbs2().asDiagonal();
  P_.block<3, 3>(kTheta, kTheta) = alignment.attitude_covariance;
  P_.block<3, 3>(kTheta, kAccelerometer) = alignment.attitude_by_accelerometer;
  P_.block<3, 3>(kAccelerometer, kTheta) = alignment.attitude_by_accelerometer.transpose();
  P_.block<3, 1>(kTheta, kCompass) = alignment.attitude_by_compass;
  P_.block<1, 3>(kCompass, kTheta) = alignment.attitude_by_compass.transpose();
  publish();
}

void Navigation::predict(const sensors::ImuReading& imu) {
  const sensors::ImuReading last = last_imu_.value_or(imu);
  const bool first = !last_imu_;
  last_imu_ = imu;
  w_WB_B_ = imu.w_WB_B_meas - gyro_bias_;
  if (!first) {
    // Means over the step by the trapezoidal rule; the specific force is rotated by the attitude at mid-step.
    const Eigen::Vector3d w = 0.5 * (last.w_WB_B_meas + imu.w_WB_B_meas) - gyro_bias_;
    const Eigen::Vector3d f = 0.5 * (last.specific_force_B_meas + imu.specific_force_B_meas) - accelerometer_bias_;
    const Eigen::Matrix3d R_WB = (q_WB_ * rotation(0.5 * dt_s_ * w)).toRotationMatrix();
    const Eigen::Vector3d a_WB_W = R_WB * f + kGravityMps2 * Eigen::Vector3d::UnitZ();
    p_WB_ += dt_s_ * (v_WB_W_ + 0.5 * dt_s_ * a_WB_W);
    v_WB_W_ += dt_s_ * a_WB_W;
    const Eigen::Quaterniond turn = rotation(dt_s_ * w);
    q_WB_ = (q_WB_ * turn).normalized();
    q_WB_gyro_ = (q_WB_gyro_ * turn).normalized();
    propagate_errors(R_WB, w, f);

    since_velocity_s_ += dt_s_;
    if (since_velocity_s_ > kCoastAfterS) {
      since_velocity_s_ -= 1.0;
      for (int i = 0; i < 3; ++i) {
        Row H = Row::Zero();
        H[kV + i] = 1.0;
        correct(H, -v_WB_W_[i], square(kCoastSigmaMps));
      }
      inject();
    }
  }
  history_[next_] = {p_WB_, v_WB_W_};
  next_ = (next_ + 1) % history_.size();
  publish();
}

void Navigation::propagate_errors(const Eigen::Matrix3d& R_WB, const Eigen::Vector3d& w, const Eigen::Vector3d& f) {
  const sensors::ImuConfig& imu = sensors_.imu;
  const sensors::GaussMarkov gps{sensors_.gps.wander_horizontal_m, sensors_.gps.wander_time_s};
  const sensors::GaussMarkov barometer = sensors::barometer_wander(sensors_.barometer);
  gps_wander_m_ *= gps.decay(dt_s_);
  barometer_wander_pa_ *= barometer.decay(dt_s_);
  // F P F' with the few blocks of F that are not those of the identity; P is symmetric.
  const Eigen::Matrix3d theta_to_theta = -dt_s_ * skew(w), theta_to_v = -dt_s_ * R_WB * skew(f);
  const double gps_decay = gps.decay(dt_s_), barometer_decay = barometer.decay(dt_s_);
  for (int side = 0; side < 2; ++side) {
    auto theta = P_.middleRows<3>(kTheta), v = P_.middleRows<3>(kV);
    P_.middleRows<3>(kP) += dt_s_ * v;
    v += theta_to_v.lazyProduct(theta) - dt_s_ * R_WB.lazyProduct(P_.middleRows<3>(kAccelerometer));
    theta += (theta_to_theta.lazyProduct(theta)).eval() - dt_s_ * P_.middleRows<3>(kGyro);
    P_.middleRows<2>(kWander) *= gps_decay;
    P_.row(kBarometer) *= barometer_decay;
    P_.transposeInPlace();
  }
  P_.diagonal().segment<3>(kTheta).array() += variance_of(imu.gyro_noise_density, kMinGyroDensity) * dt_s_;
  P_.diagonal().segment<3>(kV).array() +=
      variance_of(imu.accelerometer_noise_density, kMinAccelerometerDensity) * dt_s_;
  P_.diagonal().segment<2>(kP).array() += square(config_.drift_mps_rt_hz) * dt_s_;
  P_.diagonal().segment<3>(kGyro).array() += square(sensors::gyro_wander(imu).added_sigma(dt_s_));
  P_.diagonal().segment<3>(kAccelerometer).array() += square(sensors::accelerometer_wander(imu).added_sigma(dt_s_));
  P_.diagonal().segment<2>(kWander).array() += square(gps.added_sigma(dt_s_));
  P_(kBarometer, kBarometer) += square(barometer.added_sigma(dt_s_));
}

/// Applies one scalar measurement. @param innovation  measured - predicted, from the state without `correction_`.
/// A reading far more exact than its prediction is applied in Joseph's form, [Sola2017] sec. 6.1, which keeps the
/// covariance positive. Otherwise the short form is equal within rounding.
void Navigation::correct(const Row& H, double innovation, double variance) {
  const Column PH = P_ * H.transpose();
  const double S = std::max(H.dot(PH), 0.0) + variance;
  const Column K = PH / S;
  correction_ += K * (innovation - H.dot(correction_));
  P_.noalias() -= K * PH.transpose();
  if (variance > kIllConditioned * S) return;
  // P - K H P so far; times (I - K H)', plus K variance K'.
  const Column rest = P_ * H.transpose();
  P_ += (variance * K - rest) * K.transpose();
  P_ = (0.5 * (P_ + P_.transpose())).eval();
}

/// Moves the accumulated correction into the state. Source: [Sola2017] eqs. (282)-(283).
void Navigation::inject() {
  q_WB_ = (q_WB_ * rotation(correction_.segment<3>(kTheta))).normalized();
  v_WB_W_ += correction_.segment<3>(kV);
  p_WB_ += correction_.segment<3>(kP);
  gyro_bias_ += correction_.segment<3>(kGyro);
  accelerometer_bias_ += correction_.segment<3>(kAccelerometer);
  w_WB_B_ -= correction_.segment<3>(kGyro);
  gps_wander_m_ += correction_.segment<2>(kWander);
  compass_offset_rad_ += correction_[kCompass];
  barometer_wander_pa_ += correction_[kBarometer];
  for (Past& past : history_) {
    past.p_WB += correction_.segment<3>(kP);
    past.v_WB_W += correction_.segment<3>(kV);
  }
  correction_.setZero();
  publish();
}

void Navigation::correct_velocity(const Eigen::Vector2d& v_WB_B_xy_meas, double sigma_mps) {
  const Eigen::Matrix3d R_BW = q_WB_.toRotationMatrix().transpose();
  const Eigen::Vector3d v_WB_B = R_BW * v_WB_W_;
  const Eigen::Matrix3d by_attitude = skew(v_WB_B);
  for (int i = 0; i < 2; ++i) {
    Row H = Row::Zero();
    H.segment<3>(kTheta) = by_attitude.row(i);
    H.segment<3>(kV) = R_BW.row(i);
    const double innovation = v_WB_B_xy_meas[i] - v_WB_B[i];
    // Beyond the gate, the weight of a measurement falls with its innovation but stays positive, so that the filter can
    // recover from a wrong state.
    const double S = H * P_ * H.transpose() + square(sigma_mps);
    const double excess = std::max(1.0, square(innovation) / (kGate * S));
    correct(H, innovation, square(sigma_mps) + S * (excess - 1.0));
  }
  since_velocity_s_ = 0.0;
  inject();
}

void Navigation::correct_gps(const sensors::GpsFix& fix) {
  const sensors::GpsConfig& gps = sensors_.gps;
  const Past& then = history_[next_];  // the oldest: one latency ago
  for (int i = 0; i < 2; ++i) {
    Row H = Row::Zero();
    H[kP + i] = H[kWander + i] = 1.0;
    correct(H, fix.p_WB_W_meas[i] - then.p_WB[i] - gps_wander_m_[i], variance_of(gps.noise_m, kMinPositionM));
  }
  // The wandering altitude error is not a state. White noise of the same density at low frequency gives it the correct
  // weight.
  const double white = 2.0 * gps.wander_time_s * gps.rate_hz;
  Row H = Row::Zero();
  H[kP + 2] = 1.0;
  correct(H, fix.p_WB_W_meas.z() - then.p_WB.z(),
          white * square(gps.wander_vertical_m) + variance_of(gps.noise_m, kMinPositionM));
  for (int i = 0; i < 3 && config_.use_gps_velocity; ++i) {
    H.setZero();
    H[kV + i] = 1.0;
    correct(H, fix.v_WB_W_meas[i] - then.v_WB_W[i], variance_of(gps.velocity_noise_mps, kMinVelocityMps));
  }
  since_velocity_s_ = 0.0;
  inject();
}

void Navigation::correct_heading(double heading_meas_rad) {
  const Eigen::Vector3d rpy = to_roll_pitch_heading(q_WB_);
  Row H = Row::Zero();
  H[kTheta + 1] = std::sin(rpy[0]) / std::cos(rpy[1]);
  H[kTheta + 2] = std::cos(rpy[0]) / std::cos(rpy[1]);
  H[kCompass] = 1.0;
  const double innovation = wrap_angle(heading_meas_rad - rpy[2] - compass_offset_rad_);
  correct(H, innovation, variance_of(sensors_.magnetometer.noise_rad, kMinHeadingRad));
  inject();
}

/// A reading is the height above the ground if it fits, otherwise above the known surface below. If it fits neither and
/// the next readings agree, the surface has changed and the altitude has not.
void Navigation::correct_height(double height_meas_m) {
  last_height_m_ = height_meas_m;
  const double altitude_m = -p_WB_.z();
  const sensors::RangerConfig& ranger = sensors_.height_sensor.ranger;
  const double sigma_m = std::hypot(sensors::noise_sigma_m(ranger, height_meas_m), ranger.offset_m);
  const double altitude_sigma_m = std::sqrt(P_(kP + 2, kP + 2));
  const double near_m = config_.surface_jump_m + 3.0 * sigma_m;
  if (std::abs(height_meas_m - altitude_m) <= near_m + 3.0 * altitude_sigma_m) {
    surface_m_ = surface_sigma_m_ = 0.0;
  } else if (std::abs(height_meas_m - (altitude_m - surface_m_)) > near_m) {
    const double surface_m = altitude_m - height_meas_m;
    jump_count_ = jump_count_ > 0 && std::abs(surface_m - jump_surface_m_) <= near_m ? jump_count_ + 1 : 1;
    jump_surface_m_ = surface_m;
    if (jump_count_ < kJumpReadings) return publish();
    surface_m_ = surface_m;
    surface_sigma_m_ = altitude_sigma_m;
  }
  jump_count_ = 0;
  correct_altitude(height_meas_m - (altitude_m - surface_m_),
                   variance_of(sigma_m, kMinPositionM) + square(surface_sigma_m_));
}

void Navigation::correct_altitude(double innovation_m, double variance_m2) {
  Row H = Row::Zero();
  H[kP + 2] = -1.0;
  correct(H, innovation_m, variance_m2);
  // Repeated readings do not reduce the uncertainty of the surface and of the sensor's offset.
  const double min_sigma_m = std::hypot(surface_sigma_m_, sensors_.height_sensor.ranger.offset_m);
  P_(kP + 2, kP + 2) = std::max(P_(kP + 2, kP + 2), square(min_sigma_m));
  inject();
}

void Navigation::correct_pressure(double pressure_meas_pa) {
  const air::StandardAir air = air::standard_air(-p_WB_.z());
  Row H = Row::Zero();
  H[kP + 2] = air.density_kgpm3 * kGravityMps2;
  H[kBarometer] = 1.0;
  correct(H, pressure_meas_pa - air.pressure_pa - barometer_wander_pa_,
          variance_of(sensors_.barometer.noise_pa, kMinPressurePa));
  inject();
}

void Navigation::publish() {
  estimate_.p_WB_est = p_WB_;
  estimate_.q_WB_est = q_WB_;
  estimate_.q_WB_gyro = q_WB_gyro_;
  estimate_.v_WB_B_est = q_WB_.conjugate() * v_WB_W_;
  estimate_.w_WB_B_est = w_WB_B_;
  estimate_.height_above_ground_m = jump_count_ > 0 ? last_height_m_ : std::max(0.0, -p_WB_.z() - surface_m_);
  const Column sigma = P_.diagonal().cwiseMax(0.0).cwiseSqrt();
  estimate_.sigma_attitude_B_rad = sigma.segment<3>(kTheta);
  estimate_.sigma_v_W_mps = sigma.segment<3>(kV);
  estimate_.sigma_p_W_m = sigma.segment<3>(kP);
}

}  // namespace hedgehop::dynamics::control
