#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "vision/camera/pinhole_camera.h"
#include "vision/flow/flow_field.h"

namespace hedgehop::vision::flow {

/// Returns the flow of a point at z = 1 m, in units of the focal length per second, [-v_x + U v_z, -v_y + V v_z]; that
/// of a point at z is 1 / z of it. Source: [Garratt2009] eq. (1), translation alone.
/// @param place   (U, V) of the point, in units of the focal length. @param v_WC_C  velocity of the camera in C, m/s.
Eigen::Vector2d unit_flow(const Eigen::Vector2d& place, const Eigen::Vector3d& v_WC_C);

/// Returns a flow vector in units of the focal length per second. @param dt_s  between the two images, > 0.
Eigen::Vector2d flow_per_s(const FlowVector& vector, const camera::PinholeCamera& camera, double dt_s);

/// Returns the inverse depth 1 / z that one flow vector proves, 1/m, >= 0, given the camera's motion: with b the flow
/// of a point at z = 1 m, unit_flow(), the flow of a point at z is b / z. A component across b can only be an error (of
/// the flow, or of the rotation removed), so an equal amount is subtracted along b:
///   1/z = max(0, b . flow - |b x flow|) / (b . b + floor^2) .
/// The floor biases the estimate towards "far" where the camera's motion hardly shifts a patch, above all around the
/// focus of expansion.
/// @param v_WC_C     velocity of the camera in C, m/s.
/// @param dt_s       between the two images, > 0.
/// @param floor_mps  > 0.
/// Source: [Garratt2009] eq. (1) with rotation taken away, solved for one depth per vector.
double inverse_depth_per_m(const FlowVector& vector, const camera::PinholeCamera& camera, const Eigen::Vector3d& v_WC_C,
                           double dt_s, double floor_mps);

/// Returns the inverse horizontal range of every patch of a field, 1/m, in the field's order: inverse_depth_per_m(),
/// with range measured in the plane of C's x and z. NaN where a patch is not valid: nothing is known of it.
/// @param field  derotated.
std::vector<double> inverse_ranges_per_m(const FlowField& field, const camera::PinholeCamera& camera,
                                         const Eigen::Vector3d& v_WC_C, double dt_s, double floor_mps);

/// Returns how well each patch measures its range, in the field's order: 0 at the focus of expansion, towards 1 where
/// parallax is large, b . b / (b . b + floor^2) with b as in inverse_depth_per_m(). The expected value of that function
/// is the true value times this weight.
std::vector<double> parallax_weights(const FlowField& field, const camera::PinholeCamera& camera,
                                     const Eigen::Vector3d& v_WC_C, double floor_mps);

/// Returns the azimuth of every patch's center right of the optical axis, rad, in the field's order.
std::vector<double> bearings_rad(const FlowField& field, const camera::PinholeCamera& camera);

/// Returns the mean of the largest `share` of inverse ranges, 1/m, 0 for none: an obstacle that fills that share of the
/// view counts in full, however far away the rest is. NaN counts as far. @param share  in (0, 1]; at least one value is
/// taken.
double nearest_inverse_range_per_m(std::vector<double> inverse_ranges_per_m, double share);

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
