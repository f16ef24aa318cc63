#pragma once

#include <Eigen/Core>

/// Optic flow on the unit sphere: rays instead of pixels, so that it holds for any lens.
namespace hedgehop::vision::flow {

/// Returns the ray that a corner would have in the newer image, had the camera not rotated.
/// @param after_C  in C at the newer image (C2). @param R_C1C2  rotation of C2 in C at the older image (C1).
/// @return in C1. Source: [Zingg2010] eq. (5). Differs: the whole rotation, not a product of three changes of angle.
Eigen::Vector3d derotate_ray(const Eigen::Vector3d& after_C, const Eigen::Matrix3d& R_C1C2);

/// Returns the angle between two rays of any length, rad, 0..pi. Over the time between the images it is the flow.
/// Source: [Zingg2010] eq. (6) and (7). Differs: from the sine as well, for the arc cosine of 1 loses half the digits.
double flow_angle_rad(const Eigen::Vector3d& before, const Eigen::Vector3d& after);

/// Returns the distance of a fixed point from where the camera is at the newer image, m; +inf without flow.
/// @param before, after  rays in the older and newer image in one frame, derotated, length 1.
/// @param traveled  of the camera between the images, in that frame, m.
/// Source: [Zingg2010] eq. (2). Differs: the sine of the flow's angle instead of the angle: by the law of sines it then
/// holds for finite motion, from the newer place.
double distance_m(const Eigen::Vector3d& before, const Eigen::Vector3d& after, const Eigen::Vector3d& traveled);

/// Returns the angle between the direction of a ray's flow and that of a fixed point's flow, rad, 0..pi. A fixed
/// point's flow follows the great circle away from the direction of travel. pi / 2 where either is undefined.
/// Parameters as distance_m().
double direction_error_rad(const Eigen::Vector3d& before, const Eigen::Vector3d& after,
                           const Eigen::Vector3d& traveled);

/// Returns the angle between a flow vector and the tangent of the circle round `center_px` on which it begins, rad,
/// 0..pi/2; pi / 2 where there is no flow. Source: [Zingg2010] sec. IV-D.
double off_tangent_rad(const Eigen::Vector2d& before_px, const Eigen::Vector2d& after_px,
                       const Eigen::Vector2d& center_px);

}  // namespace hedgehop::vision::flow
