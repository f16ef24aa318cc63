#pragma once

#include <Eigen/Core>

#include "avoidance/stereo_corridor/corridor_search.h"

/// A speed limit, an addition of the modified law.
namespace hedgehop::avoidance::stereo_corridor {

/// Returns the maximum speed, m/s, from which a vehicle that flies on in its present direction stops before the nearest
/// obstacle in a corridor of the given radius; +infinity if it hovers, or if its direction is not in view. The vehicle
/// may fly in another direction than its target's: its climb rate is limited, and a low speed steepens its climb.
/// @param pyramid  of the filtered disparity. @param radius_m  > 0. @param v_WB_C  velocity in C, m/s.
/// @param acceleration_mps2  of the stop, > 0. @param hull_m  extent of the hull ahead of the camera, >= 0.
double stopping_speed_mps(const vision::stereo::DepthPyramid& pyramid, const vision::stereo::StereoGeometry& geometry,
                          double radius_m, const Eigen::Vector3d& v_WB_C, double acceleration_mps2, double hull_m);

}  // namespace hedgehop::avoidance::stereo_corridor
