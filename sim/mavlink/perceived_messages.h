#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "avoidance/module.h"
#include "sim/mavlink/obstacle_sectors.h"
#include "sim/mavlink/perception_messages.h"
#include "vision/flow/ground_velocity.h"

/// The messages about one instant. Times are those of the autopilot.
namespace hedgehop::sim::mavlink {

/// @param limits  of the sectors, at most 655 m.
ObstacleDistance obstacle_distance(int64_t t_ns, const ObstacleSectors& sectors, const SectorLimits& limits);

/// Returns the reading of a range finder along the body's down axis. Autopilots multiply it by the cosine of the tilt.
/// @param height_m  vertical, above ground. @param q_WB_est  attitude of B.
DistanceSensor height_reading(int64_t t_ns, double height_m, const Eigen::Quaterniond& q_WB_est);
/// Returns the reading of an upright vehicle on the ground.
DistanceSensor height_reading_on_ground(int64_t t_ns);

/// @param p_origin_W  origin of the autopilot's local frame in W, m.
VisionPositionEstimate vision_position(int64_t t_ns, const avoidance::NavigationState& navigation,
                                       const Eigen::Vector3d& p_origin_W);
Odometry odometry(int64_t t_ns, const avoidance::NavigationState& navigation, const Eigen::Vector3d& p_origin_W);

/// Optical flow as the angular velocity about the axes of B at which a camera that only rotates has the same flow at
/// the image of the ground below Bo.
struct PerceivedFlow {
  Eigen::Vector2d flow_B_radps = Eigen::Vector2d::Zero();   ///< about forward and right
  Eigen::Vector2d v_WB_B_xy_mps = Eigen::Vector2d::Zero();  ///< without the rotation, metric by the height
  Eigen::Vector3d w_WB_B_radps = Eigen::Vector3d::Zero();   ///< from the gyros
  double distance_m = 0.0;                                  ///< of the ground along the body's down axis
  double dt_s = 0.0;                                        ///< between the images
  double quality = 0.0;                                     ///< share of agreeing vectors, 0 to 1
};
PerceivedFlow perceived_flow(const vision::flow::GroundVelocityReading& reading);

/// @param focal_px  of the camera, for the flow in pixels.
OpticalFlow optical_flow(int64_t t_ns, const PerceivedFlow& flow, double focal_px);
OpticalFlowRad optical_flow_rad(int64_t t_ns, const PerceivedFlow& flow);

}  // namespace hedgehop::sim::mavlink
