#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace hedgehop::vision::flow {

/// What one patch of one of several cameras measures of the walls around a vehicle. Frame H: level, x along the
/// heading, origin at B.
struct WallFlowSample {
  Eigen::Vector2d ray_H = Eigen::Vector2d::Zero();      ///< of its center, at z = 1 m of its camera; the level part
  Eigen::Vector2d p_BC_H = Eigen::Vector2d::Zero();     ///< of its camera, m
  Eigen::Vector2d unit_flow = Eigen::Vector2d::Zero();  ///< of a point at z = 1 m, see unit_flow(), focal lengths per s
  Eigen::Vector2d flow = Eigen::Vector2d::Zero();       ///< derotated, focal lengths per s
  double noise = 0.0;                                   ///< standard deviation of a component of `flow`, > 0
};

/// An upright wall: the unit vector n to its nearest point over that point's distance d from B.
struct WallEstimate {
  Eigen::Vector2d inverse_range_per_m = Eigen::Vector2d::Zero();  ///< n / d, in H
  double relative_error = 0.0;                                    ///< standard deviation of 1/d over 1/d
};

/// Returns the upright walls that explain the flow all around a vehicle, in the order of their bearings.
/// A wall's point along a ray r of a camera at p lies at 1/z = r.m / (1 - m.p) with m = n/d. A flow f = b / z is
/// therefore linear in m, f = (b r + f p).m, and m follows by least squares over all patches of the wall. Patches with
/// large parallax so determine the range also for those around the focus of expansion.
/// The borders between walls minimize the squared residual over the noise plus a penalty for each wall, so that noise
/// creates none (dynamic programming). Ours.
/// @param samples  in the order of their bearings. @param relative_error  greatest one of a returned wall; > 0.
std::vector<WallEstimate> walls_from_flow(std::span<const WallFlowSample> samples, double relative_error);

}  // namespace hedgehop::vision::flow
