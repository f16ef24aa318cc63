#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "sim/fields/field.h"

/// Messages between PX4 and its simulator. Units are those of the wire. Source of all: [Mavlink2024] sec. on
/// common.xml.
namespace hedgehop::sim::mavlink {

/// Readings of the inertial sensors, compass and barometer in B. PX4's clock follows `time_usec` of sensor 0.
struct HilSensor {
  static constexpr uint32_t kId = 107;
  static constexpr std::string_view kName = "HIL_SENSOR";

  uint64_t time_usec = 0;  ///< µs
  float xacc = 0.0f;       ///< specific force, m/s^2
  float yacc = 0.0f;
  float zacc = 0.0f;
  float xgyro = 0.0f;  ///< rad/s
  float ygyro = 0.0f;
  float zgyro = 0.0f;
  float xmag = 0.0f;  ///< gauss
  float ymag = 0.0f;
  float zmag = 0.0f;
  float abs_pressure = 0.0f;    ///< hPa
  float diff_pressure = 0.0f;   ///< hPa
  float pressure_alt = 0.0f;    ///< m
  float temperature = 0.0f;     ///< deg C
  uint32_t fields_updated = 0;  ///< a bit per field; bit 31: reset
  uint8_t id = 0;
};
template <class Visitor>
constexpr void list_fields(Visitor& v, fields::ConfigOf<HilSensor> auto& m) {
  v("time_usec", m.time_usec);
  v("xacc", m.xacc);
  v("yacc", m.yacc);
  v("zacc", m.zacc);
  v("xgyro", m.xgyro);
  v("ygyro", m.ygyro);
  v("zgyro", m.zgyro);
  v("xmag", m.xmag);
  v("ymag", m.ymag);
  v("zmag", m.zmag);
  v("abs_pressure", m.abs_pressure);
  v("diff_pressure", m.diff_pressure);
  v("pressure_alt", m.pressure_alt);
  v("temperature", m.temperature);
  v("fields_updated", m.fields_updated);
  v.extensions();
  v("id", m.id);
}

/// A fix of a satellite receiver.
struct HilGps {
  static constexpr uint32_t kId = 113;
  static constexpr std::string_view kName = "HIL_GPS";

  uint64_t time_usec = 0;  ///< µs
  int32_t lat = 0;         ///< 1e-7 deg
  int32_t lon = 0;         ///< 1e-7 deg
  int32_t alt = 0;         ///< mm
  uint16_t eph = 0;        ///< cm
  uint16_t epv = 0;        ///< cm
  uint16_t vel = 0;        ///< cm/s
  int16_t vn = 0;          ///< cm/s
  int16_t ve = 0;
  int16_t vd = 0;
  uint16_t cog = 0;      ///< 0.01 deg
  uint8_t fix_type = 0;  ///< 3: 3D
  uint8_t satellites_visible = 0;
  uint8_t id = 0;
  uint16_t yaw = 0;  ///< 0.01 deg; 0: none
};
template <class Visitor>
constexpr void list_fields(Visitor& v, fields::ConfigOf<HilGps> auto& m) {
  v("time_usec", m.time_usec);
  v("lat", m.lat);
  v("lon", m.lon);
  v("alt", m.alt);
  v("eph", m.eph);
  v("epv", m.epv);
  v("vel", m.vel);
  v("vn", m.vn);
  v("ve", m.ve);
  v("vd", m.vd);
  v("cog", m.cog);
  v("fix_type", m.fix_type);
  v("satellites_visible", m.satellites_visible);
  v.extensions();
  v("id", m.id);
  v("yaw", m.yaw);
}

/// The true state, for the autopilot's log.
struct HilStateQuaternion {
  static constexpr uint32_t kId = 115;
  static constexpr std::string_view kName = "HIL_STATE_QUATERNION";

  uint64_t time_usec = 0;                      ///< µs
  std::array<float, 4> attitude_quaternion{};  ///< w, x, y, z
  float rollspeed = 0.0f;                      ///< rad/s
  float pitchspeed = 0.0f;
  float yawspeed = 0.0f;
  int32_t lat = 0;  ///< 1e-7 deg
  int32_t lon = 0;
  int32_t alt = 0;  ///< mm
  int16_t vx = 0;   ///< cm/s
  int16_t vy = 0;
  int16_t vz = 0;
  uint16_t ind_airspeed = 0;   ///< cm/s
  uint16_t true_airspeed = 0;  ///< cm/s
  int16_t xacc = 0;            ///< mm/s^2, as PX4 reads it; the definition: mG
  int16_t yacc = 0;
  int16_t zacc = 0;
};
template <class Visitor>
constexpr void list_fields(Visitor& v, fields::ConfigOf<HilStateQuaternion> auto& m) {
  v("time_usec", m.time_usec);
  v("attitude_quaternion", m.attitude_quaternion);
  v("rollspeed", m.rollspeed);
  v("pitchspeed", m.pitchspeed);
  v("yawspeed", m.yawspeed);
  v("lat", m.lat);
  v("lon", m.lon);
  v("alt", m.alt);
  v("vx", m.vx);
  v("vy", m.vy);
  v("vz", m.vz);
  v("ind_airspeed", m.ind_airspeed);
  v("true_airspeed", m.true_airspeed);
  v("xacc", m.xacc);
  v("yacc", m.yacc);
  v("zacc", m.zacc);
}

/// Outputs of PX4's mixer: motors 0 to 1, servos -1 to 1; all 0 while disarmed.
struct HilActuatorControls {
  static constexpr uint32_t kId = 93;
  static constexpr std::string_view kName = "HIL_ACTUATOR_CONTROLS";

  uint64_t time_usec = 0;  ///< of the HIL_SENSOR that it answers, µs
  uint64_t flags = 0;      ///< 1: lockstep
  std::array<float, 16> controls{};
  uint8_t mode = 0;  ///< MAV_MODE_FLAG; 128: armed
};
template <class Visitor>
constexpr void list_fields(Visitor& v, fields::ConfigOf<HilActuatorControls> auto& m) {
  v("time_usec", m.time_usec);
  v("flags", m.flags);
  v("controls", m.controls);
  v("mode", m.mode);
}

}  // namespace hedgehop::sim::mavlink
