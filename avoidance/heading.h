#pragma once

#include <Eigen/Geometry>

#include "avoidance/module.h"

/// Frame H: at B's origin, level, x along the heading, y to the right.
namespace hedgehop::avoidance {

/// Returns the heading of an attitude, from north to east, in (-pi, pi], rad: where B's x axis points in the plan.
/// @param q_WB  of length 1, not pointing straight up or down.
double heading_rad(const Eigen::Quaterniond& q_WB);

/// Returns a horizontal vector rotated by an angle, positive from x to y: from north to east, or from forward to right.
Eigen::Vector2d rotated(const Eigen::Vector2d& vector, double angle_rad);

/// Returns the estimated horizontal velocity in H, m/s.
Eigen::Vector2d velocity_H(const NavigationState& navigation);

}  // namespace hedgehop::avoidance
