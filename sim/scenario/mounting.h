#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "sim/scenario/rig.h"
#include "vision/camera/camera.h"

namespace hedgehop::sim {

/// Returns the angle that one pixel spans along a column at the optical axis, rad: 1 over the focal length in px.
double pixel_angle_rad(const vision::camera::Camera& camera);

/// Returns the pose in B from which a camera's images are drawn: that of its calibration, CameraConfig::X_BC(), and its
/// errors. `side_error` moves it along its rows, `row_error` turns it about them, so that the image of what is far
/// stands so many rows off at the optical axis.
/// @param model  of the camera. @param seed  of the flight: the camera's own stream decides both signs.
Eigen::Isometry3d true_X_BC(const CameraConfig& camera, const vision::camera::Camera& model, uint64_t seed);

}  // namespace hedgehop::sim
