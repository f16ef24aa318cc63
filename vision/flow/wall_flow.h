#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace hedgehop::vision::flow {

/// What one patch of one of several cameras sees of the walls round a vehicle, in a level frame H at its origin B.
struct WallObservation {
  Eigen::Vector2d ray_H = Eigen::Vector2d::Zero();      ///< of its center, at z = 1 m of its camera; the level part
  Eigen::Vector2d p_BC_H = Eigen::Vector2d::Zero();     ///< of its camera, m
  Eigen::Vector2d unit_flow = Eigen::Vector2d::Zero();  ///< of a point at z = 1 m, see unit_flow(), focal lengths per s
  Eigen::Vector2d flow = Eigen::Vector2d::Zero();       ///< less that of rotation, focal lengths per s
  double noise = 0.0;                                   ///< standard deviation of a component of `flow`, > 0
};

/// An upright wall: the direction n of its nearest point over that point's distance d from B, 1/m, in H.
struct WallEstimate {
  Eigen::Vector2d inverse_range_per_m = Eigen::Vector2d::Zero();
  double relative_error = 0.0;  ///< standard deviation of 1/d over 1/d
};

/// Returns the upright walls that explain the flow all round a vehicle, in their order. A wall's point along a ray r of
/// a camera at p lies at 1/z = r.m / (1 - m.p) with m = n/d, so that a flow f = b / z is linear in m, f = (b r + f
/// p).m: least squares over all patches of a wall let those that parallax shifts most tell the range of those around
/// the focus of expansion, which it hardly shifts. Where one wall ends and the next begins is chosen so that what is
/// left of the flow, over its noise, is least, with a price for every wall so that chance makes none (dynamic
/// programming). Ours.
/// @param observations  in the order of their bearings. @param relative_error  of a wall, at most; > 0.
std::vector<WallEstimate> walls_from_flow(std::span<const WallObservation> observations, double relative_error);

}  // namespace hedgehop::vision::flow
