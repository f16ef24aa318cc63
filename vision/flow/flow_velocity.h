#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "vision/camera/pinhole_camera.h"
#include "vision/flow/flow_field.h"

namespace hedgehop::vision::flow {

/// Parameters for measuring velocity with a camera that images the ground.
struct FlowVelocityConfig {
  int min_vectors = 8;              ///< minimum number of valid and of agreeing vectors
  double min_height_m = 0.1;        ///< minimum height for a measurement
  double max_view_angle_rad = 1.2;  ///< maximum angle of rays to the vertical, because range is uncertain beyond
  double sigma_floor_mps = 0.02;    ///< lower bound of the standard deviation
};

/// A velocity measured from a flow field.
struct FlowVelocity {
  Eigen::Vector2d v_WB_B_xy_meas = Eigen::Vector2d::Zero();  ///< forward and right, m/s
  double sigma_mps = 0.0;                                    ///< of each component
  int agreeing = 0;                                          ///< number of vectors in the fit
};

/// Motion of the aircraft between the two images of a field, as measured by other sensors.
struct FlowMotion {
  Eigen::Quaterniond q_WB = Eigen::Quaterniond::Identity();  ///< attitude at the older image
  Eigen::Vector3d w_WB_B = Eigen::Vector3d::Zero();          ///< mean angular velocity (gyros), rad/s
  double height_above_ground_m = 0.0;                        ///< of B, measured vertically, at the older image
  double dt_s = 0.0;                                         ///< between the images, > 0
};

/// Returns the body's horizontal velocity from the flow of level ground in one camera. Each vector without its
/// rotational part is a linear equation in the velocity, given the range at which its ray meets the ground. The fit is
/// robust: it starts at the median and continues with least squares reweighted by Tukey's biweight, so that walls and
/// roofs in less than half of the view have no effect. It includes the vertical velocity to avoid bias of the
/// horizontal components.
/// @param X_BC  pose of the camera in B.  @return std::nullopt if too few vectors are valid or agree, if they do
/// not determine the velocity, below `min_height_m`, or unless `dt_s` is positive.
/// Source: [Garratt2009] eq. (1) and sec. 4 (velocity from the down camera). Differs: a robust fit over the field.
std::optional<FlowVelocity> flow_velocity(const FlowField& field, const camera::PinholeCamera& camera,
                                          const Eigen::Isometry3d& X_BC, const FlowMotion& motion,
                                          const FlowVelocityConfig& config = {});

}  // namespace hedgehop::vision::flow
