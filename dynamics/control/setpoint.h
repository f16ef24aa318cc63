#pragma once

#include <Eigen/Core>
#include <variant>

/// What the autopilot is commanded to do.
namespace hedgehop::dynamics::control {

/// Fly at a horizontal velocity, hold a height and a heading.
struct VelocitySetpoint {
  Eigen::Vector2d v_WB_W = Eigen::Vector2d::Zero();  ///< north, east, m/s
  double altitude_m = 0.0;                           ///< above W's origin, positive up
  double heading_rad = 0.0;                          ///< from north to east
};
/// Fly to a point and stay there.
struct PositionSetpoint {
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();  ///< m
  double heading_rad = 0.0;
};
/// Hold an attitude and a height; roll and pitch 0 are the attitude of the trimmed hover.
struct AttitudeSetpoint {
  double roll_rad = 0.0, pitch_rad = 0.0, heading_rad = 0.0, altitude_m = 0.0;
};
/// Stop and stay where it stopped; turn at `yaw_rate_radps`.
struct HoverSetpoint {
  double yaw_rate_radps = 0.0;
};
using Setpoint = std::variant<VelocitySetpoint, PositionSetpoint, AttitudeSetpoint, HoverSetpoint>;

}  // namespace hedgehop::dynamics::control
