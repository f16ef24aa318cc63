#pragma once

#include <Eigen/Core>

#include "vision/camera/pinhole_camera.h"
#include "vision/flow/flow_field.h"

namespace hedgehop::vision::flow {

/// Returns the image Jacobian: the motion of a pixel, px/s, per camera velocity and angular velocity [v_WC_C; w_WC_C]
/// (m/s, rad/s) for a fixed point at depth z:
///   u_dot = -f_x v_x / z + U v_z / z + U V w_x / f_y - (f_x + U^2 / f_x) w_y + (f_x / f_y) V w_z
///   v_dot = -f_y v_y / z + V v_z / z + (f_y + V^2 / f_y) w_x - U V w_y / f_x - (f_y / f_x) U w_z
/// with (U, V) the pixel relative to the camera's center.
/// @param depth_m  z in C, > 0; +inf for a point at infinity.
/// Source: [Garratt2009] eq. (1) after [Corke2004]. Differs: columns 4 and 5 are misprinted in the paper, and its
/// velocities have the opposite sign; derived here from P_dot = -v - w x P.
Eigen::Matrix<double, 2, 6> image_jacobian(const camera::PinholeCamera& camera, const Eigen::Vector2d& pixel,
                                           double depth_m);

/// Returns the motion of a pixel, px, while the camera rotates at a constant w_WC_C (rad/s) for dt_s. Exact.
Eigen::Vector2d rotation_flow_px(const camera::PinholeCamera& camera, const Eigen::Vector2d& pixel,
                                 const Eigen::Vector3d& w_WC_C, double dt_s);

/// Subtracts rotation_flow_px() from every valid vector. The remaining flow is due to translation.
void derotate(FlowField& field, const camera::PinholeCamera& camera, const Eigen::Vector3d& w_WC_C, double dt_s);

/// Treatment of invalid vectors in averages over an image.
enum class Missing {
  skip,      ///< ignored: the average is over the valid vectors
  far_away,  ///< counted as zero flow, as if no obstacle is close
};

/// An average over a flow field.
struct FlowAverage {
  double value = 0.0;  ///< 0 if count is 0
  int count = 0;       ///< number of valid vectors used
};

/// Returns the mean horizontal flow Q, rad/s on the axis: flow / (focal length * dt), positive to the right. A camera
/// that moves right with v_x past a wall at range z measures Q = -v_x / z.
/// @param dt_s  time between the two images, > 0.
/// Source: [Garratt2009] sec. 4.1.
FlowAverage mean_horizontal_flow(const FlowField& field, const camera::PinholeCamera& camera, double dt_s,
                                 Missing missing);

/// Returns the loom L = v_z / z, 1/s, which is positive if the camera approaches the scene; 1 / L is the time to
/// contact,
///   L = [sum_right Q_u - sum_left Q_u] / [sum_right U - sum_left U] ,
/// over pairs of patches that are symmetric about the center column, so that lateral motion and rotation cancel
/// (rotation to first order: a yaw rate w leaves w^2 dt). A pair with an invalid vector is ignored; with
/// Missing::far_away it still contributes to the denominator.
/// Source: [Garratt2009] eq. (3). Differs: the sign, our z is forward.
FlowAverage loom(const FlowField& field, double dt_s, Missing missing);

}  // namespace hedgehop::vision::flow
