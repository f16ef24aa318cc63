#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "avoidance/module.h"

/// Frame H: at B's origin, level, x along the heading, y to the right.
namespace hedgehop::avoidance {

/// Returns the heading of an attitude: the azimuth of the x axis of B from north to east, in (-pi, pi], rad.
/// @param q_WB  of length 1; the nose must not point straight up or down.
inline double heading_rad(const Eigen::Quaterniond& q_WB) {
  const Eigen::Vector3d forward_W = q_WB * Eigen::Vector3d::UnitX();
  return std::atan2(forward_W.y(), forward_W.x());
}

/// Returns an angle or a difference of headings in [-pi, pi], rad.
inline double wrap_angle(double angle_rad) { return std::remainder(angle_rad, 2.0 * std::numbers::pi); }

/// Returns a horizontal vector rotated by an angle, positive from x to y: from north to east, or from forward to right.
inline Eigen::Vector2d rotated(const Eigen::Vector2d& vector, double angle_rad) {
  return Eigen::Rotation2Dd(angle_rad) * vector;
}

/// Returns the estimated horizontal velocity in H, m/s.
inline Eigen::Vector2d velocity_H(const NavigationState& navigation) {
  const Eigen::Vector2d v_WB_W = (navigation.q_WB_est * navigation.v_WB_B_est).head<2>();
  return rotated(v_WB_W, -heading_rad(navigation.q_WB_est));
}

}  // namespace hedgehop::avoidance
