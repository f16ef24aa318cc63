#pragma once

#include <Eigen/Core>

#include "vision/camera/pinhole_camera.h"
#include "vision/flow/flow_field.h"

namespace hedgehop::vision::flow {

/// Returns how a pixel moves, px/s, per camera velocity and angular velocity [v_WC_C; w_WC_C] (m/s, rad/s) when it
/// shows a fixed point at depth z:
///   u_dot = -f_x v_x / z + U v_z / z + U V w_x / f_y - (f_x + U^2 / f_x) w_y + (f_x / f_y) V w_z
///   v_dot = -f_y v_y / z + V v_z / z + (f_y + V^2 / f_y) w_x - U V w_y / f_x - (f_y / f_x) U w_z
/// with (U, V) the pixel less the camera's center.
/// @param depth_m  z in C, > 0; +inf for a point infinitely far.
/// Source: [Garratt2009] eq. (1) after [Corke2004], of which the print garbles columns 4 and 5 (and gives velocities
/// the other sign); derived here from P_dot = -v - w x P.
Eigen::Matrix<double, 2, 6> image_jacobian(const camera::PinholeCamera& camera, const Eigen::Vector2d& pixel,
                                           double depth_m);

/// Returns how far a pixel moves, px, while the camera turns at a constant w_WC_C (rad/s) for dt_s. Exact.
Eigen::Vector2d rotation_flow_px(const camera::PinholeCamera& camera, const Eigen::Vector2d& pixel,
                                 const Eigen::Vector3d& w_WC_C, double dt_s);

/// Takes rotation_flow_px() away from every valid vector: what remains is due to translation.
void derotate(FlowField& field, const camera::PinholeCamera& camera, const Eigen::Vector3d& w_WC_C, double dt_s);

/// What an invalid vector means when an image is averaged.
enum class Missing {
  skip,      ///< nothing is known there: average the others
  far_away,  ///< nothing near is there: it counts as no flow
};

/// An average over a flow field.
struct FlowAverage {
  double value = 0.0;  ///< 0 when count is 0
  int count = 0;       ///< valid vectors that entered
};

/// Mean horizontal flow Q, rad/s on the axis: flow / (focal length * dt). Positive to the right; a camera moving right
/// past a wall at range z with v_x sees Q = -v_x / z.
/// @param dt_s  time between the two images, > 0.
/// Source: [Garratt2009] sec. 4.1.
FlowAverage mean_horizontal_flow(const FlowField& field, const camera::PinholeCamera& camera, double dt_s,
                                 Missing missing);

/// Loom L = v_z / z, 1/s: positive when the camera approaches what it sees, 1 / L is the time to contact,
///   L = [sum_right Q_u - sum_left Q_u] / [sum_right U - sum_left U] ,
/// over pairs of patches that mirror one another about the middle column, so that sideways motion and rotation cancel
/// (rotation to first order: turning at w leaves w^2 dt). A pair of which one vector is invalid is left out; with
/// Missing::far_away it still counts below the line.
/// Source: [Garratt2009] eq. (3). Differs: the sign, our z is forward.
FlowAverage loom(const FlowField& field, double dt_s, Missing missing);

}  // namespace hedgehop::vision::flow
