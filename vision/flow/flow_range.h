#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "vision/camera/pinhole_camera.h"
#include "vision/flow/flow_field.h"

namespace hedgehop::vision::flow {

/// Returns the flow of a point at z = 1 m, in focal lengths per second: [-v_x + U v_z, -v_y + V v_z]. The flow of a
/// point at z is 1 / z times that. Source: [Garratt2009] eq. (1), translation only.
/// @param place   (U, V) of the point, in units of the focal length. @param v_WC_C  velocity of the camera in C, m/s.
Eigen::Vector2d unit_flow(const Eigen::Vector2d& place, const Eigen::Vector3d& v_WC_C);

/// Returns a flow vector in focal lengths per second. @param dt_s  between the two images, > 0.
Eigen::Vector2d flow_per_s(const FlowVector& vector, const camera::PinholeCamera& camera, double dt_s);

/// Returns a conservative inverse depth 1 / z from one flow vector and the camera's motion, 1/m, >= 0. With b the flow
/// of a point at z = 1 m, unit_flow(), the flow of a point at z is b / z. A component across b is an error of the flow
/// or of the removed rotation, so an equal amount is subtracted along b:
///   1/z = max(0, b . flow - |b x flow|) / (b . b + floor^2) .
/// The floor biases the estimate toward larger depth if the camera's motion hardly shifts a patch, mainly around the
/// focus of expansion.
/// @param v_WC_C     velocity of the camera in C, m/s.
/// @param dt_s       between the two images, > 0.
/// @param floor_mps  > 0.
/// Source: [Garratt2009] eq. (1) without rotation, solved for one depth per vector.
double inverse_depth_per_m(const FlowVector& vector, const camera::PinholeCamera& camera, const Eigen::Vector3d& v_WC_C,
                           double dt_s, double floor_mps);

/// Returns the inverse horizontal range of every patch of a field, 1/m, in the field's order: inverse_depth_per_m()
/// with range measured in the x-z plane of C. NaN for invalid patches.
/// @param field  derotated.
std::vector<double> inverse_ranges_per_m(const FlowField& field, const camera::PinholeCamera& camera,
                                         const Eigen::Vector3d& v_WC_C, double dt_s, double floor_mps);

/// Returns the parallax weight of each patch, in the field's order: b . b / (b . b + floor^2) with b as in
/// inverse_depth_per_m(). It is 0 at the focus of expansion and approaches 1 for large parallax. The expected value of
/// inverse_depth_per_m() is the true value times this weight.
std::vector<double> parallax_weights(const FlowField& field, const camera::PinholeCamera& camera,
                                     const Eigen::Vector3d& v_WC_C, double floor_mps);

/// Returns the azimuth of every patch's center to the right of the optical axis, rad, in the field's order.
std::vector<double> bearings_rad(const FlowField& field, const camera::PinholeCamera& camera);

/// Returns the mean of the largest `share` of inverse ranges, 1/m; 0 without ranges. An obstacle that fills this share
/// of the view determines the result. NaN counts as infinitely far. @param share  in (0, 1]; at least one value is
/// used.
double nearest_inverse_range_per_m(std::vector<double> inverse_ranges_per_m, double share);

/// The flow of one patch of one of several cameras, as a measurement of the walls around a vehicle. Frame H: level, x
/// along the heading, origin at B.
struct WallFlowSample {
  Eigen::Vector2d ray_H = Eigen::Vector2d::Zero();      ///< horizontal part of its center's ray at z = 1 m
  Eigen::Vector2d p_BC_H = Eigen::Vector2d::Zero();     ///< position of its camera, m
  Eigen::Vector2d unit_flow = Eigen::Vector2d::Zero();  ///< of a point at z = 1 m, unit_flow(), focal lengths per s
  Eigen::Vector2d flow = Eigen::Vector2d::Zero();       ///< derotated, focal lengths per s
  double noise = 0.0;                                   ///< standard deviation of a component of `flow`, > 0
};

/// A vertical wall: n / d, with n the unit vector to its nearest point and d that point's distance from B.
struct WallEstimate {
  Eigen::Vector2d inverse_range_per_m = Eigen::Vector2d::Zero();  ///< n / d, in H
  double relative_error = 0.0;                                    ///< standard deviation of 1/d over 1/d
};

/// Returns the vertical walls that explain the flow around a vehicle, in the order of their bearings.
/// A wall's point along a ray r of a camera at p has 1/z = r.m / (1 - m.p) with m = n/d. A flow f = b / z is therefore
/// linear in m, f = (b r + f p).m, and m follows by least squares over all patches of the wall. Patches with large
/// parallax thus determine the range for those around the focus of expansion.
/// Dynamic programming places the borders between walls. It minimizes the squared residual relative to the noise plus a
/// penalty per wall, so that noise creates no walls. Not from the paper.
/// @param samples  in the order of their bearings. @param relative_error  maximum relative error of a returned wall, >
/// 0.
std::vector<WallEstimate> walls_from_flow(std::span<const WallFlowSample> samples, double relative_error);

}  // namespace hedgehop::vision::flow
