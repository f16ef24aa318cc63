#pragma once

#include <Eigen/Core>
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

}  // namespace hedgehop::vision::flow
