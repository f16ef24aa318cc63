#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "dynamics/control/alignment.h"
#include "dynamics/sensors/barometer.h"
#include "dynamics/sensors/gps.h"
#include "dynamics/sensors/imu.h"
#include "dynamics/sensors/magnetometer.h"
#include "dynamics/sensors/ranger.h"
#include "sim/fields/field.h"

namespace hedgehop::dynamics::control {

/// Settings of the filter. Its noise model follows from the sensors' configs.
struct NavigationConfig {
  bool use_gps_velocity = true;
  double position_sigma_m = 0.1;  ///< of the surveyed initial position, per axis
  double surface_jump_m = 0.5;    ///< a height residual above this indicates another surface below
  double drift_mps_rt_hz = 0.3;   ///< position drift caused by slow velocity errors, m / sqrt(s)
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<NavigationConfig> auto& c) {
  v("use_gps_velocity", c.use_gps_velocity, {.meaning = "whether satellite velocities correct the velocity"});
  v("position_sigma", c.position_sigma_m,
    {.unit = "m", .above = 0.0, .meaning = "standard deviation of the surveyed initial position, per axis"});
  v("surface_jump", c.surface_jump_m,
    {.unit = "m", .above = 0.0, .meaning = "height residual above which another surface is assumed below"});
  v("drift", c.drift_mps_rt_hz,
    {.unit = "m/s/sqrt(Hz)",
     .at_least = 0.0,
     .meaning =
         "assumed position drift: velocities from optic flow have errors of a few per cent that last for minutes"});
}

/// Estimated state of the aircraft. Standard deviations are 1 sigma, as the filter computes them.
struct NavigationEstimate {
  Eigen::Vector3d p_WB_est = Eigen::Vector3d::Zero();            ///< m
  Eigen::Quaterniond q_WB_est = Eigen::Quaterniond::Identity();  ///< attitude of B in W
  Eigen::Vector3d v_WB_B_est = Eigen::Vector3d::Zero();          ///< m/s, expressed in B
  Eigen::Vector3d w_WB_B_est = Eigen::Vector3d::Zero();          ///< gyro reading minus estimated bias, rad/s
  /// Attitude integrated from the gyros alone since the start. It drifts, but has no jumps from corrections: for
  /// rotations between two instants.
  Eigen::Quaterniond q_WB_gyro = Eigen::Quaterniond::Identity();
  double height_above_ground_m = 0.0;  ///< above the surface below, >= 0
  Eigen::Vector3d sigma_p_W_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma_attitude_B_rad = Eigen::Vector3d::Zero();  ///< small rotations about B's axes
  Eigen::Vector3d sigma_v_W_mps = Eigen::Vector3d::Zero();
};

/// An error-state extended Kalman filter. It estimates attitude, velocity, position, the biases of the inertial
/// sensors, the wandering errors of satellite position and barometer, and the compass offset. The prediction is
/// inertial. The corrections are velocity from the optic flow of a downward camera, height, pressure, heading and
/// satellite fixes. Accelerations do not bias the attitude, because it is corrected through the velocity. Sources: the
/// fusion of flow, height and inertial data [GarrattChahl2007] sec. 3; error-state form [Sola2017] sec. 5-6.
class Navigation {
 public:
  struct Sensors {
    sensors::ImuConfig imu;
    sensors::GpsConfig gps;
    sensors::HeightSensorConfig height_sensor;
    sensors::MagnetometerConfig magnetometer;
    sensors::BarometerConfig barometer;
  };

  /// Throws std::invalid_argument on values out of range.
  Navigation(const NavigationConfig& config, const Sensors& sensors);

  /// Starts in a hover. @param alignment  of the attitude in this hover. @param p_WB_est  surveyed position, m.
  void reset(const Alignment& alignment, const Eigen::Vector3d& p_WB_est);

  void predict(const sensors::ImuReading& imu);
  /// @param v_WB_B_xy_meas  forward and right velocity in B, m/s. @param sigma_mps  of each, > 0.
  void correct_velocity(const Eigen::Vector2d& v_WB_B_xy_meas, double sigma_mps);
  void correct_gps(const sensors::GpsFix& fix);
  void correct_heading(double heading_meas_rad);
  void correct_height(double height_meas_m);
  void correct_pressure(double pressure_meas_pa);

  const NavigationEstimate& estimate() const { return estimate_; }

 private:
  static constexpr int kSize = 19;
  using Row = Eigen::Matrix<double, 1, kSize>;
  using Column = Eigen::Matrix<double, kSize, 1>;
  using Square = Eigen::Matrix<double, kSize, kSize>;
  struct Past {
    Eigen::Vector3d p_WB, v_WB_W;
  };

  void propagate_errors(const Eigen::Matrix3d& R_WB, const Eigen::Vector3d& w, const Eigen::Vector3d& f);
  void correct(const Row& H, double innovation, double variance);
  void correct_altitude(double innovation_m, double variance_m2);
  void inject();
  void publish();

  NavigationConfig config_;
  Sensors sensors_;
  double dt_s_;
  Square P_;
  Column correction_;  ///< of the error state, not yet injected
  Eigen::Quaterniond q_WB_, q_WB_gyro_;
  Eigen::Vector3d v_WB_W_, p_WB_, gyro_bias_, accelerometer_bias_, w_WB_B_;
  Eigen::Vector2d gps_wander_m_;
  double compass_offset_rad_ = 0.0;
  double barometer_wander_pa_ = 0.0;
  std::optional<sensors::ImuReading> last_imu_;
  double since_velocity_s_ = 0.0;

  double surface_m_ = 0.0;        ///< altitude of the surface below; 0 for the ground
  double surface_sigma_m_ = 0.0;  ///< 0 for the ground
  int jump_count_ = 0;            ///< successive readings that indicate the same other surface
  double jump_surface_m_ = 0.0, last_height_m_ = 0.0;

  std::vector<Past> history_;  ///< ring buffer as long as the latency of satellite fixes
  size_t next_ = 0;
  NavigationEstimate estimate_;
};

}  // namespace hedgehop::dynamics::control
