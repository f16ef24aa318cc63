#include "sim/mavlink/perceived_messages.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "avoidance/heading.h"
#include "sim/mavlink/message_fields.h"

namespace hedgehop::sim::mavlink {
namespace {

constexpr uint8_t kUnknownSensor = 4;             // MAV_DISTANCE_SENSOR
constexpr uint8_t kBodyFrd = 12, kLocalFrd = 20;  // MAV_FRAME
constexpr uint8_t kDownwards = 25;                // MAV_SENSOR_ORIENTATION
constexpr uint8_t kVisualInertial = 3;            // MAV_ESTIMATOR_TYPE
constexpr uint16_t kUnknownCm = std::numeric_limits<uint16_t>::max();
constexpr float kNoCovariance = std::numeric_limits<float>::quiet_NaN();
constexpr double kMaxHeightM = 100.0;
constexpr double kFlowVectors = 64.0;  // of vision::flow::GroundVelocity

uint64_t microseconds(int64_t t_ns) { return static_cast<uint64_t>(t_ns / 1000); }
uint32_t milliseconds(int64_t t_ns) { return static_cast<uint32_t>(t_ns / 1'000'000); }

uint16_t centimeters(double value_m) { return rounded<uint16_t>(100.0 * value_m); }

/// Returns cos(tilt): the share of a length along the body's down axis that is vertical.
double upright(const Eigen::Quaterniond& q_WB) { return (q_WB * Eigen::Vector3d::UnitZ()).z(); }

struct EulerAngles {
  double roll_rad, pitch_rad, yaw_rad;
};
EulerAngles angles_of(const Eigen::Quaterniond& q_WB) {
  const Eigen::Matrix3d R_WB = q_WB.toRotationMatrix();
  return {std::atan2(R_WB(2, 1), R_WB(2, 2)), -std::asin(std::clamp(R_WB(2, 0), -1.0, 1.0)),
          avoidance::heading_rad(q_WB)};
}

DistanceSensor downward_reading(int64_t t_ns, double range_m) {
  return {.time_boot_ms = milliseconds(t_ns),
          .min_distance = 5,
          .max_distance = centimeters(kMaxHeightM),
          .current_distance = centimeters(range_m),
          .type = 0,
          .id = 1,
          .orientation = kDownwards,
          .covariance = std::numeric_limits<uint8_t>::max()};
}

}  // namespace

ObstacleDistance obstacle_distance(int64_t t_ns, const ObstacleSectors& sectors, const SectorLimits& limits) {
  ObstacleDistance message{.time_usec = microseconds(t_ns),
                           .min_distance = centimeters(limits.min_m),
                           .max_distance = centimeters(limits.max_m),
                           .sensor_type = kUnknownSensor,
                           .increment = static_cast<uint8_t>(ObstacleSectors::kWidthDeg)};
  message.frame = kBodyFrd;
  for (int i = 0; i < ObstacleSectors::kCount; ++i) {
    const SectorRange& range = sectors.at(i);
    uint16_t& distance = message.distances[static_cast<size_t>(i)];
    if (!range.seen) {
      distance = kUnknownCm;
    } else if (std::isinf(range.nearest_m)) {
      distance = static_cast<uint16_t>(message.max_distance + 1);
    } else {
      distance = std::clamp(centimeters(range.nearest_m), message.min_distance, message.max_distance);
    }
  }
  return message;
}

DistanceSensor height_reading(int64_t t_ns, double height_m, const Eigen::Quaterniond& q_WB_est) {
  constexpr double kMinUpright = 0.1;  // beyond it, the beam does not meet the ground
  return downward_reading(t_ns, height_m / std::max(kMinUpright, upright(q_WB_est)));
}

DistanceSensor height_reading_on_ground(int64_t t_ns) { return downward_reading(t_ns, 0.0); }

VisionPositionEstimate vision_position(int64_t t_ns, const avoidance::NavigationState& navigation,
                                       const Eigen::Vector3d& p_origin_W) {
  const Eigen::Vector3f p = (navigation.p_WB_est - p_origin_W).cast<float>();
  const EulerAngles angles = angles_of(navigation.q_WB_est);
  VisionPositionEstimate message{.usec = microseconds(t_ns),
                                 .x = p.x(),
                                 .y = p.y(),
                                 .z = p.z(),
                                 .roll = static_cast<float>(angles.roll_rad),
                                 .pitch = static_cast<float>(angles.pitch_rad),
                                 .yaw = static_cast<float>(angles.yaw_rad)};
  message.covariance[0] = kNoCovariance;
  return message;
}

Odometry odometry(int64_t t_ns, const avoidance::NavigationState& navigation, const Eigen::Vector3d& p_origin_W) {
  const Eigen::Vector3f p = (navigation.p_WB_est - p_origin_W).cast<float>();
  const Eigen::Vector3f v = navigation.v_WB_B_est.cast<float>(), w = navigation.w_WB_B_est.cast<float>();
  const Eigen::Quaternionf q = navigation.q_WB_est.cast<float>();
  Odometry message{.time_usec = microseconds(t_ns),
                   .x = p.x(),
                   .y = p.y(),
                   .z = p.z(),
                   .q = {q.w(), q.x(), q.y(), q.z()},
                   .vx = v.x(),
                   .vy = v.y(),
                   .vz = v.z(),
                   .rollspeed = w.x(),
                   .pitchspeed = w.y(),
                   .yawspeed = w.z()};
  message.pose_covariance[0] = message.velocity_covariance[0] = kNoCovariance;
  message.frame_id = kLocalFrd;
  message.child_frame_id = kBodyFrd;
  message.estimator_type = kVisualInertial;
  return message;
}

PerceivedFlow perceived_flow(const vision::flow::GroundVelocityReading& reading) {
  const vision::flow::FlowMotion& motion = reading.motion;
  const double distance_m = motion.height_above_ground_m / upright(motion.q_WB);
  const Eigen::Vector2d& v = reading.velocity.v_WB_B_xy_meas;
  return {.flow_B_radps = {motion.w_WB_B.x() - v.y() / distance_m, motion.w_WB_B.y() + v.x() / distance_m},
          .v_WB_B_xy_mps = v,
          .w_WB_B_radps = motion.w_WB_B,
          .distance_m = distance_m,
          .dt_s = motion.dt_s,
          .quality = std::min(1.0, reading.velocity.agreeing / kFlowVectors)};
}

OpticalFlow optical_flow(int64_t t_ns, const PerceivedFlow& flow, double focal_px) {
  const Eigen::Vector2d tenths_px = 10.0 * focal_px * flow.dt_s * flow.flow_B_radps;
  return {.time_usec = microseconds(t_ns),
          .flow_comp_m_x = static_cast<float>(flow.v_WB_B_xy_mps.x()),
          .flow_comp_m_y = static_cast<float>(flow.v_WB_B_xy_mps.y()),
          .ground_distance = static_cast<float>(flow.distance_m),
          .flow_x = rounded<int16_t>(tenths_px.x()),
          .flow_y = rounded<int16_t>(tenths_px.y()),
          .quality = rounded<uint8_t>(255.0 * flow.quality),
          .flow_rate_x = static_cast<float>(flow.flow_B_radps.x()),
          .flow_rate_y = static_cast<float>(flow.flow_B_radps.y())};
}

OpticalFlowRad optical_flow_rad(int64_t t_ns, const PerceivedFlow& flow) {
  const auto integrated = [&](double rate_radps) { return static_cast<float>(rate_radps * flow.dt_s); };
  const auto dt_us = rounded<uint32_t>(1e6 * flow.dt_s);
  return {.time_usec = microseconds(t_ns),
          .integration_time_us = dt_us,
          .integrated_x = integrated(flow.flow_B_radps.x()),
          .integrated_y = integrated(flow.flow_B_radps.y()),
          .integrated_xgyro = integrated(flow.w_WB_B_radps.x()),
          .integrated_ygyro = integrated(flow.w_WB_B_radps.y()),
          .integrated_zgyro = integrated(flow.w_WB_B_radps.z()),
          .time_delta_distance_us = dt_us,
          .distance = static_cast<float>(flow.distance_m),
          .quality = rounded<uint8_t>(255.0 * flow.quality)};
}

}  // namespace hedgehop::sim::mavlink
