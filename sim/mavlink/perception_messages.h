#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "sim/fields/field.h"

/// Perception of a companion computer, as messages for the autopilot. Units are those of the wire. Frames: W, and B for
/// "ahead", "right" and "down". Source of all: [Mavlink2024] sec. on common.xml.
namespace hedgehop::sim::mavlink {

/// Ranges in equal sectors around the vehicle, clockwise from `angle_offset`.
struct ObstacleDistance {
  static constexpr uint32_t kId = 330;
  static constexpr std::string_view kName = "OBSTACLE_DISTANCE";

  uint64_t time_usec = 0;                ///< µs
  std::array<uint16_t, 72> distances{};  ///< cm; max_distance + 1: free; 65535: unknown
  uint16_t min_distance = 0;             ///< cm
  uint16_t max_distance = 0;             ///< cm
  uint8_t sensor_type = 0;               ///< MAV_DISTANCE_SENSOR; 4: unknown
  uint8_t increment = 0;                 ///< width of a sector, deg
  float increment_f = 0.0f;              ///< deg; replaces `increment` if not 0
  float angle_offset = 0.0f;             ///< of the first sector, deg
  uint8_t frame = 0;                     ///< MAV_FRAME; 12: B
};
template <class Visitor>
constexpr void list_fields(Visitor& v, fields::ConfigOf<ObstacleDistance> auto& m) {
  v("time_usec", m.time_usec);
  v("distances", m.distances);
  v("min_distance", m.min_distance);
  v("max_distance", m.max_distance);
  v("sensor_type", m.sensor_type);
  v("increment", m.increment);
  v.extensions();
  v("increment_f", m.increment_f);
  v("angle_offset", m.angle_offset);
  v("frame", m.frame);
}

/// One range finder.
struct DistanceSensor {
  static constexpr uint32_t kId = 132;
  static constexpr std::string_view kName = "DISTANCE_SENSOR";

  uint32_t time_boot_ms = 0;      ///< ms
  uint16_t min_distance = 0;      ///< cm
  uint16_t max_distance = 0;      ///< cm
  uint16_t current_distance = 0;  ///< cm
  uint8_t type = 0;               ///< MAV_DISTANCE_SENSOR; 0: laser
  uint8_t id = 0;
  uint8_t orientation = 0;            ///< 0: ahead, 2: right, 4: back, 6: left, 24: up, 25: down
  uint8_t covariance = 0;             ///< cm^2; 255: unknown
  float horizontal_fov = 0.0f;        ///< rad
  float vertical_fov = 0.0f;          ///< rad
  std::array<float, 4> quaternion{};  ///< for orientation 100
  uint8_t signal_quality = 0;         ///< %; 0: unknown
};
template <class Visitor>
constexpr void list_fields(Visitor& v, fields::ConfigOf<DistanceSensor> auto& m) {
  v("time_boot_ms", m.time_boot_ms);
  v("min_distance", m.min_distance);
  v("max_distance", m.max_distance);
  v("current_distance", m.current_distance);
  v("type", m.type);
  v("id", m.id);
  v("orientation", m.orientation);
  v("covariance", m.covariance);
  v.extensions();
  v("horizontal_fov", m.horizontal_fov);
  v("vertical_fov", m.vertical_fov);
  v("quaternion", m.quaternion);
  v("signal_quality", m.signal_quality);
}

/// Optical flow of the ground; ArduPilot reads this message.
struct OpticalFlow {
  static constexpr uint32_t kId = 100;
  static constexpr std::string_view kName = "OPTICAL_FLOW";

  uint64_t time_usec = 0;        ///< µs
  float flow_comp_m_x = 0.0f;    ///< velocity over ground ahead, m/s
  float flow_comp_m_y = 0.0f;    ///< velocity over ground to the right, m/s
  float ground_distance = 0.0f;  ///< m; < 0: unknown
  int16_t flow_x = 0;            ///< 0.1 px
  int16_t flow_y = 0;            ///< 0.1 px
  uint8_t sensor_id = 0;
  uint8_t quality = 0;       ///< 0 to 255
  float flow_rate_x = 0.0f;  ///< about the axes of B as if the vehicle rotated, rad/s
  float flow_rate_y = 0.0f;
};
template <class Visitor>
constexpr void list_fields(Visitor& v, fields::ConfigOf<OpticalFlow> auto& m) {
  v("time_usec", m.time_usec);
  v("flow_comp_m_x", m.flow_comp_m_x);
  v("flow_comp_m_y", m.flow_comp_m_y);
  v("ground_distance", m.ground_distance);
  v("flow_x", m.flow_x);
  v("flow_y", m.flow_y);
  v("sensor_id", m.sensor_id);
  v("quality", m.quality);
  v.extensions();
  v("flow_rate_x", m.flow_rate_x);
  v("flow_rate_y", m.flow_rate_y);
}

/// Optical flow of the ground, integrated; PX4 reads this message.
struct OpticalFlowRad {
  static constexpr uint32_t kId = 106;
  static constexpr std::string_view kName = "OPTICAL_FLOW_RAD";

  uint64_t time_usec = 0;            ///< µs
  uint32_t integration_time_us = 0;  ///< µs
  float integrated_x = 0.0f;         ///< about the axes of B as if the vehicle rotated, rad: motion to the right: x < 0
  float integrated_y = 0.0f;         ///< motion ahead: y > 0
  float integrated_xgyro = 0.0f;     ///< rotation in this time, rad
  float integrated_ygyro = 0.0f;
  float integrated_zgyro = 0.0f;
  uint32_t time_delta_distance_us = 0;  ///< µs
  float distance = 0.0f;                ///< m; < 0: unknown
  int16_t temperature = 0;              ///< 0.01 deg C
  uint8_t sensor_id = 0;
  uint8_t quality = 0;  ///< 0 to 255
};
template <class Visitor>
constexpr void list_fields(Visitor& v, fields::ConfigOf<OpticalFlowRad> auto& m) {
  v("time_usec", m.time_usec);
  v("integration_time_us", m.integration_time_us);
  v("integrated_x", m.integrated_x);
  v("integrated_y", m.integrated_y);
  v("integrated_xgyro", m.integrated_xgyro);
  v("integrated_ygyro", m.integrated_ygyro);
  v("integrated_zgyro", m.integrated_zgyro);
  v("time_delta_distance_us", m.time_delta_distance_us);
  v("distance", m.distance);
  v("temperature", m.temperature);
  v("sensor_id", m.sensor_id);
  v("quality", m.quality);
}

/// Estimated pose in the local frame (axes of W).
struct VisionPositionEstimate {
  static constexpr uint32_t kId = 102;
  static constexpr std::string_view kName = "VISION_POSITION_ESTIMATE";

  uint64_t usec = 0;                   ///< µs
  float x = 0.0f;                      ///< north, m
  float y = 0.0f;                      ///< east, m
  float z = 0.0f;                      ///< down, m
  float roll = 0.0f;                   ///< rad
  float pitch = 0.0f;                  ///< rad
  float yaw = 0.0f;                    ///< rad
  std::array<float, 21> covariance{};  ///< upper triangle by rows; first NaN: unknown
  uint8_t reset_counter = 0;
};
template <class Visitor>
constexpr void list_fields(Visitor& v, fields::ConfigOf<VisionPositionEstimate> auto& m) {
  v("usec", m.usec);
  v("x", m.x);
  v("y", m.y);
  v("z", m.z);
  v("roll", m.roll);
  v("pitch", m.pitch);
  v("yaw", m.yaw);
  v.extensions();
  v("covariance", m.covariance);
  v("reset_counter", m.reset_counter);
}

/// Estimated pose in the local frame and velocity in B.
struct Odometry {
  static constexpr uint32_t kId = 331;
  static constexpr std::string_view kName = "ODOMETRY";

  uint64_t time_usec = 0;  ///< µs
  float x = 0.0f;          ///< m
  float y = 0.0f;
  float z = 0.0f;
  std::array<float, 4> q{};  ///< w, x, y, z: attitude of B in the local frame
  float vx = 0.0f;           ///< ahead, m/s
  float vy = 0.0f;           ///< right, m/s
  float vz = 0.0f;           ///< down, m/s
  float rollspeed = 0.0f;    ///< rad/s
  float pitchspeed = 0.0f;
  float yawspeed = 0.0f;
  std::array<float, 21> pose_covariance{};      ///< first NaN: unknown
  std::array<float, 21> velocity_covariance{};  ///< first NaN: unknown
  uint8_t frame_id = 0;                         ///< MAV_FRAME; 20: local, forward-right-down
  uint8_t child_frame_id = 0;                   ///< MAV_FRAME; 12: B
  uint8_t reset_counter = 0;
  uint8_t estimator_type = 0;  ///< MAV_ESTIMATOR_TYPE; 3: visual-inertial
  int8_t quality = 0;          ///< %; 0: unknown
};
template <class Visitor>
constexpr void list_fields(Visitor& v, fields::ConfigOf<Odometry> auto& m) {
  v("time_usec", m.time_usec);
  v("x", m.x);
  v("y", m.y);
  v("z", m.z);
  v("q", m.q);
  v("vx", m.vx);
  v("vy", m.vy);
  v("vz", m.vz);
  v("rollspeed", m.rollspeed);
  v("pitchspeed", m.pitchspeed);
  v("yawspeed", m.yawspeed);
  v("pose_covariance", m.pose_covariance);
  v("velocity_covariance", m.velocity_covariance);
  v("frame_id", m.frame_id);
  v("child_frame_id", m.child_frame_id);
  v.extensions();
  v("reset_counter", m.reset_counter);
  v("estimator_type", m.estimator_type);
  v("quality", m.quality);
}

}  // namespace hedgehop::sim::mavlink
