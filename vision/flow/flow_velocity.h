#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "sim/fields/field.h"
#include "vision/camera/pinhole_camera.h"
#include "vision/flow/flow_field.h"

namespace hedgehop::vision::flow {

/// How a velocity is measured by a camera that sees the ground.
struct FlowVelocityConfig {
  int min_vectors = 8;              ///< with fewer valid or agreeing vectors there is no velocity
  double min_height_m = 0.1;        ///< below this there is no velocity
  double max_view_angle_rad = 1.2;  ///< rays further from the vertical are left out: their range is too uncertain
  double sigma_floor_mps = 0.02;    ///< what no number of vectors improves on
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<FlowVelocityConfig> auto& c) {
  v("min_vectors", c.min_vectors, {.at_least = 3, .meaning = "valid flow vectors needed for a velocity"});
  v("min_height", c.min_height_m, {.unit = "m", .above = 0.0, .meaning = "height below which no velocity is measured"});
  v("max_view_angle", c.max_view_angle_rad,
    {.unit = "deg", .above = 0.0, .at_most = 85.0, .meaning = "rays further from the vertical are left out"});
  v("sigma_floor", c.sigma_floor_mps,
    {.unit = "m/s", .at_least = 0.0, .meaning = "standard deviation that no number of vectors improves on"});
}

/// A velocity measured from a flow field.
struct FlowVelocity {
  Eigen::Vector2d v_WB_B_xy_meas = Eigen::Vector2d::Zero();  ///< forward and right, m/s
  double sigma_mps = 0.0;                                    ///< of each component
  int agreeing = 0;                                          ///< vectors that entered the fit
};

/// Motion of the aircraft between the two images of a field, as far as other sensors know it.
struct FlowMotion {
  Eigen::Quaterniond q_WB = Eigen::Quaterniond::Identity();  ///< attitude at the older image
  Eigen::Vector3d w_WB_B = Eigen::Vector3d::Zero();          ///< mean angular velocity (gyros), rad/s
  double height_above_ground_m = 0.0;                        ///< of B, measured vertically, at the older image
  double dt_s = 0.0;                                         ///< between the images, > 0
};

/// Returns the body's horizontal velocity from the flow of level ground seen by one camera: each vector, less what
/// rotation explains, is a linear equation in the velocity, given the range at which its ray meets the ground. The
/// velocity (all three components; the vertical one only so that it does not disturb the others) is found robustly: a
/// median start, then least squares reweighted by Tukey's biweight, so that walls and roofs in less than half of the
/// view do no harm.
/// @param X_BC  pose of the camera in B.  @return nothing when too little is seen, or too little agrees.
/// Source: [Garratt2009] eq. (1) and sec. 4 (velocity from the down camera). Differs: a robust fit over the field.
std::optional<FlowVelocity> flow_velocity(const FlowField& field, const camera::PinholeCamera& camera,
                                          const Eigen::Isometry3d& X_BC, const FlowMotion& motion,
                                          const FlowVelocityConfig& config = {});

}  // namespace hedgehop::vision::flow
