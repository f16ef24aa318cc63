#include "sim/link/hil_sensors.h"

#include <cmath>
#include <numbers>

#include "dynamics/air/atmosphere.h"
#include "dynamics/sensors/sensor_errors.h"
#include "sim/mavlink/message_fields.h"

namespace hedgehop::sim::link {
namespace {

// PX4's default home in simulation.
constexpr double kHomeLatitudeDeg = 47.397742, kHomeLongitudeDeg = 8.545594, kHomeAltitudeM = 488.0;
constexpr double kEarthRadiusM = 6371000.0;  // of PX4's projection of coordinates to its local frame
// Magnetic field there: strength, declination, inclination.
constexpr double kFieldGauss = 0.48, kDeclinationDeg = 3.0, kInclinationDeg = 63.4;
constexpr double kFieldNoiseGauss = 0.0004;  // of [PX4Gazebo2024], table of sensors
constexpr int64_t kFieldRateHz = 100, kPressureRateHz = 50;

// HIL_SENSOR_UPDATED_FLAGS.
constexpr uint32_t kInertial = 0x3F, kField = 0x1C0, kPressure = 0x1A00;
constexpr uint8_t kFix3d = 3, kSatellites = 10;

constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

dynamics::sensors::ImuConfig imu_config() {
  dynamics::sensors::ImuConfig config;
  config.rate_hz = static_cast<double>(HilSensors::kImuRateHz);
  config.gyro_offset_radps = config.accelerometer_offset_mps2 = config.misalignment_rad = 0.0;
  return config;
}
dynamics::sensors::BarometerConfig barometer_config() {
  return {.enabled = true, .rate_hz = static_cast<double>(kPressureRateHz), .wander_pa = 2.0};
}
dynamics::sensors::GpsConfig gps_config() {
  // Small errors: the vehicle must find the start within the link's start radius.
  return {.wander_horizontal_m = 0.2, .wander_vertical_m = 0.3, .noise_m = 0.05, .velocity_noise_mps = 0.05};
}

Eigen::Vector3d field_W() {
  const double horizontal = kFieldGauss * std::cos(radians(kInclinationDeg));
  return {horizontal * std::cos(radians(kDeclinationDeg)), horizontal * std::sin(radians(kDeclinationDeg)),
          kFieldGauss * std::sin(radians(kInclinationDeg))};
}

struct Coordinates {
  int32_t latitude_e7, longitude_e7, altitude_mm;
};
Coordinates coordinates_of(const Eigen::Vector3d& p_W) {
  constexpr double kPerDegree = 1e7 * 180.0 / std::numbers::pi;
  const double east_radius_m = kEarthRadiusM * std::cos(radians(kHomeLatitudeDeg));
  return {mavlink::rounded<int32_t>(1e7 * kHomeLatitudeDeg + kPerDegree * p_W.x() / kEarthRadiusM),
          mavlink::rounded<int32_t>(1e7 * kHomeLongitudeDeg + kPerDegree * p_W.y() / east_radius_m),
          mavlink::rounded<int32_t>(1e3 * (kHomeAltitudeM - p_W.z()))};
}

}  // namespace

HilSensors::HilSensors(int64_t physics_rate_hz, uint64_t seed)
    : physics_rate_hz_(physics_rate_hz),
      imu_(imu_config(), 1.0 / static_cast<double>(physics_rate_hz), stream_seed(seed, "px4 imu")),
      barometer_(barometer_config(), 1.0 / static_cast<double>(physics_rate_hz), stream_seed(seed, "px4 barometer")),
      gps_(gps_config(), 1.0 / static_cast<double>(physics_rate_hz), stream_seed(seed, "px4 gps")),
      field_noise_(stream_seed(seed, "px4 compass")) {}

void HilSensors::observe(const OutsideInput& input) {
  imu_.observe(input.body.w_WB_B, input.specific_force_B);
  barometer_.observe(kHomeAltitudeM - input.body.p_WB.z());
  gps_.observe(input.body.p_WB, input.body.q_WB * input.body.v_WB_B);
}

bool HilSensors::due(int64_t step, int64_t rate_hz) const {
  return step * rate_hz / physics_rate_hz_ != (step - period()) * rate_hz / physics_rate_hz_;
}

mavlink::HilSensor HilSensors::sensor(const OutsideInput& input) {
  const dynamics::sensors::ImuReading imu = imu_.read();
  const Eigen::Vector3f f = imu.specific_force_B_meas.cast<float>(), w = imu.w_WB_B_meas.cast<float>();
  mavlink::HilSensor message{.time_usec = time_us(input.step),
                             .xacc = f.x(),
                             .yacc = f.y(),
                             .zacc = f.z(),
                             .xgyro = w.x(),
                             .ygyro = w.y(),
                             .zgyro = w.z(),
                             .fields_updated = kInertial};
  if (due(input.step, kFieldRateHz)) {
    const Eigen::Vector3d noise = kFieldNoiseGauss * dynamics::sensors::normal3(field_noise_);
    const Eigen::Vector3f field_B = (input.body.q_WB.conjugate() * field_W() + noise).cast<float>();
    message.xmag = field_B.x();
    message.ymag = field_B.y();
    message.zmag = field_B.z();
    message.fields_updated |= kField;
  }
  if (!due(input.step, kPressureRateHz)) return message;
  if (const std::optional<double> pressure_pa = barometer_.read()) {
    const double altitude_m = dynamics::air::pressure_altitude_m(*pressure_pa);
    constexpr double kKelvinOffset = 273.15;
    message.abs_pressure = static_cast<float>(*pressure_pa / 100.0);
    message.pressure_alt = static_cast<float>(altitude_m);
    message.temperature = static_cast<float>(dynamics::air::standard_air(altitude_m).temperature_k - kKelvinOffset);
    message.fields_updated |= kPressure;
  }
  return message;
}

std::optional<mavlink::HilGps> HilSensors::gps(int64_t step) {
  if (step % gps_.period() != 0) return {};
  const std::optional<dynamics::sensors::GpsFix> fix = gps_.read();
  if (!fix) return {};
  const Coordinates place = coordinates_of(fix->p_WB_W_meas);
  const Eigen::Vector3d v_cmps = 100.0 * fix->v_WB_W_meas;
  const double course_deg = std::atan2(v_cmps.y(), v_cmps.x()) * 180.0 / std::numbers::pi;
  return mavlink::HilGps{
      .time_usec = time_us(step),
      .lat = place.latitude_e7,
      .lon = place.longitude_e7,
      .alt = place.altitude_mm,
      .eph = 30,
      .epv = 40,
      .vel = mavlink::rounded<uint16_t>(v_cmps.head<2>().norm()),
      .vn = mavlink::rounded<int16_t>(v_cmps.x()),
      .ve = mavlink::rounded<int16_t>(v_cmps.y()),
      .vd = mavlink::rounded<int16_t>(v_cmps.z()),
      .cog = mavlink::rounded<uint16_t>(100.0 * (course_deg < 0.0 ? course_deg + 360.0 : course_deg)),
      .fix_type = kFix3d,
      .satellites_visible = kSatellites};
}

mavlink::HilStateQuaternion HilSensors::state(const OutsideInput& input) const {
  const Coordinates place = coordinates_of(input.body.p_WB);
  const Eigen::Quaternionf q = input.body.q_WB.cast<float>();
  const Eigen::Vector3f w = input.body.w_WB_B.cast<float>();
  const Eigen::Vector3d v_W = input.body.q_WB * input.body.v_WB_B, f_mmps2 = 1e3 * input.specific_force_B;
  const auto airspeed = mavlink::rounded<uint16_t>(100.0 * (v_W - input.wind_W).norm());
  return {.time_usec = time_us(input.step),
          .attitude_quaternion = {q.w(), q.x(), q.y(), q.z()},
          .rollspeed = w.x(),
          .pitchspeed = w.y(),
          .yawspeed = w.z(),
          .lat = place.latitude_e7,
          .lon = place.longitude_e7,
          .alt = place.altitude_mm,
          .vx = mavlink::rounded<int16_t>(100.0 * v_W.x()),
          .vy = mavlink::rounded<int16_t>(100.0 * v_W.y()),
          .vz = mavlink::rounded<int16_t>(100.0 * v_W.z()),
          .ind_airspeed = airspeed,
          .true_airspeed = airspeed,
          .xacc = mavlink::rounded<int16_t>(f_mmps2.x()),
          .yacc = mavlink::rounded<int16_t>(f_mmps2.y()),
          .zacc = mavlink::rounded<int16_t>(f_mmps2.z())};
}

}  // namespace hedgehop::sim::link
