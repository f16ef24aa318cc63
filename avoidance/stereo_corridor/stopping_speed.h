#pragma once

#include <Eigen/Core>

#include "avoidance/stereo_corridor/corridor_search.h"

/// A speed limit, an addition of the modified law.
namespace hedgehop::avoidance::stereo_corridor {

/// Returns the maximum speed, m/s, from which a vehicle that flies on in its present direction stops before the nearest
/// obstacle in a corridor of the given radius; +infinity if it hovers. A direction outside the image counts as the
/// nearest pixel of its edge. To the side and backwards the vehicle may only creep. The vehicle may fly in another
/// direction than its target's: its climb rate is limited, and it turns more slowly than its target changes.
/// @param pyramid  of the filtered disparity. @param radius_m  > 0. @param v_WB_C  velocity in C, m/s.
/// @param acceleration_mps2  of the stop, > 0. @param hull_m  distance of the camera from the obstacle at the end, >=
/// 0.
double stopping_speed_mps(const vision::stereo::DepthPyramid& pyramid, const vision::stereo::StereoGeometry& geometry,
                          double radius_m, const Eigen::Vector3d& v_WB_C, double acceleration_mps2, double hull_m);

}  // namespace hedgehop::avoidance::stereo_corridor
