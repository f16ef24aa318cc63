#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "dynamics/control/autopilot.h"
#include "dynamics/control/navigation.h"
#include "dynamics/control/rate_control.h"
#include "dynamics/rigid_body.h"
#include "dynamics/sensors/barometer.h"
#include "dynamics/sensors/gps.h"
#include "dynamics/sensors/imu.h"
#include "dynamics/sensors/magnetometer.h"
#include "dynamics/sensors/ranger.h"
#include "dynamics/sensors/sensor_errors.h"
#include "dynamics/vehicle.h"
#include "sim/fields/field.h"

/// Onboard sensors, navigation filter and autopilot of one aircraft.
namespace hedgehop::dynamics {

struct AvionicsConfig {
  sensors::ImuConfig imu;
  sensors::GpsConfig gps;
  sensors::HeightSensorConfig height_sensor;
  sensors::MagnetometerConfig magnetometer;
  sensors::BarometerConfig barometer;
  sensors::RangeFinderConfig range_finder;
  control::NavigationConfig navigation;
  control::AutopilotConfig autopilot;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<AvionicsConfig> auto& c) {
  v("imu", c.imu, {.meaning = "gyros and accelerometers"});
  v("gps", c.gps, {.meaning = "satellite receiver"});
  v("height_sensor", c.height_sensor, {.meaning = "downward range finder"});
  v("magnetometer", c.magnetometer, {.meaning = "compass"});
  v("barometer", c.barometer, {.meaning = "pressure altimeter"});
  v("range_finder", c.range_finder, {.meaning = "single-beam laser, for the avoidance module"});
  v("navigation", c.navigation, {.meaning = "filter that fuses the sensors"});
  v("autopilot", c.autopilot, {.meaning = "limits of the flight control"});
}

/// Returns the seed of a named random stream.
using StreamSeeds = std::function<uint64_t(std::string_view stream_name)>;

/// Velocity over ground, measured by the optic flow of a downward camera.
struct VelocityReading {
  Eigen::Vector2d v_WB_B_xy_meas = Eigen::Vector2d::Zero();  ///< forward and right in B, m/s
  double sigma_mps = 1.0;                                    ///< 1-sigma uncertainty per axis, > 0
};
/// Measures the velocity over ground with the estimated attitude and height; nullopt if the ground has too little
/// texture.
using VelocitySensor = std::function<std::optional<VelocityReading>(const control::NavigationEstimate& navigation)>;

/// True quantities that the sensors measure at one instant.
struct SensedTruth {
  RigidBodyState body;
  Eigen::Vector3d specific_force_B = Eigen::Vector3d::Zero();  ///< of the mass center, m/s^2
  double height_above_surface_m = 0.0;                         ///< +inf if no surface is below
  sensors::HeightAtOffset height_at_offset = {};               ///< for a height sensor with a cone
  sensors::BeamDistance beam_distance = {};                    ///< for a range finder; without it, every beam misses
};

class Avionics {
 public:
  /// Throws std::invalid_argument "<key>: ..." on values out of range. @param physics_dt_s  between calls of sense().
  /// @param failures  of the sensors during the flight.
  Avionics(const AvionicsConfig& config, const VehicleConfig& vehicle, double physics_dt_s,
           const StreamSeeds& stream_seeds, const std::vector<sensors::SensorFailure>& failures = {});

  /// Starts a flight in a trimmed hover, after an alignment on the ground (control::GroundAlignment). Equivalent to a
  /// new object. The position is surveyed. Without a magnetometer, the heading is surveyed too.
  void reset(const SensedTruth& truth);
  /// Reads the sensors that are due and runs the filter. Must be called on every physics tick, from the first.
  /// @param t_ns  since the start of the flight, a whole number of physics steps.
  /// @param flow_velocity  the velocimeter, on ticks with an image. It is read last because it needs this tick's
  /// estimate.
  void sense(int64_t t_ns, const SensedTruth& truth, const VelocitySensor& flow_velocity = {});
  const control::NavigationEstimate& navigation() const { return navigation_.estimate(); }
  /// Last reading of the range finder, m; nullopt without one, out of range or on a drop-out.
  const std::optional<double>& range_m() const { return range_m_; }
  /// IMU reading on the tick of the last sense(); nullopt if none was due.
  const std::optional<sensors::ImuReading>& imu() const { return imu_reading_; }
  sensors::ImuReading imu_bias() const { return imu_.bias(); }
  /// GPS fix that arrived on the tick of the last sense(); nullopt if none did.
  const std::optional<sensors::GpsFix>& gps() const { return gps_fix_; }
  const control::Autopilot& autopilot() const { return autopilot_; }
  /// Returns the actuator commands until the next call. @param dt_s  time until then, > 0, constant during a flight.
  Controls control(const control::Setpoint& setpoint, double dt_s);
  /// As above, for body rates.
  Controls control(const control::RateSetpoint& setpoint, double dt_s);
  /// Leaves the actuators to the caller. The next setpoint starts from the estimate of its instant.
  void release();

 private:
  void reset_optional_sensors();
  control::Alignment align(double heading_rad, double surveyed_heading_rad);
  void sense_beam(int64_t t_ns, int64_t tick, const SensedTruth& truth);
  sensors::ImuReading read_imu(int64_t t_ns);
  std::optional<sensors::GpsFix> read_gps(int64_t t_ns);

  struct Seeds {
    uint64_t imu, gps, height_sensor, magnetometer, survey, barometer, range_finder;
  };
  AvionicsConfig config_;
  double physics_dt_s_;
  Eigen::Vector3d beam_direction_B_;
  Seeds seeds_;
  sensors::Imu imu_;
  std::optional<sensors::ImuReading> imu_reading_;
  sensors::Gps gps_;
  std::optional<sensors::GpsFix> gps_fix_;
  sensors::Ranger height_sensor_;
  sensors::Magnetometer magnetometer_;
  std::optional<sensors::Barometer> barometer_;
  std::optional<sensors::Ranger> range_finder_;
  std::optional<double> range_m_;
  std::vector<sensors::SensorFailure> failing_;
  sensors::SensorFailures failures_;
  control::Navigation navigation_;
  control::Autopilot autopilot_;
  bool released_ = false;                             ///< whether the last commands were not the autopilot's
  std::optional<control::RateControl> rate_control_;  ///< while body rates are commanded
};

}  // namespace hedgehop::dynamics
