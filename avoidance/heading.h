#pragma once

#include <Eigen/Geometry>

namespace hedgehop::avoidance {

/// Returns the heading of an attitude, from north to east, in (-pi, pi], rad: where B's x axis points in the plan.
/// @param q_WB  of length 1, not pointing straight up or down.
double heading_rad(const Eigen::Quaterniond& q_WB);

}  // namespace hedgehop::avoidance
