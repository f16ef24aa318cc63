#pragma once

#include <Eigen/Geometry>
#include <numbers>
#include <string>
#include <vector>

#include "avoidance/module.h"
#include "vision/pinhole_camera.h"

namespace hedgehop::sim {

/// One camera as mounted on the vehicle. All angles zero: looks along B's x, its u axis along B's y.
struct CameraConfig {
  using Channel = avoidance::CameraNeed::Channel;

  std::string role;
  int width_px = 400, height_px = 400;
  double fov_rad = std::numbers::pi / 2.0;
  double rate_hz = 50.0;
  Channel channel = Channel::grey;
  double forward_m = 0.0, right_m = 0.0, down_m = 0.0;
  double yaw_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;

  /// Pose of the camera in B: the mounting position, and yaw about down, pitch about right, roll about forward, in that
  /// order, applied to a camera that looks forward. Yaw 90 deg looks right, pitch -90 deg looks down.
  Eigen::Isometry3d X_BC() const;
  /// Throws std::invalid_argument as vision::PinholeCamera::from_fov().
  vision::PinholeCamera model() const;
};

template <class Visitor>
void describe(Visitor& v, CameraConfig& c) {
  v("role", c.role, {.required = true, .meaning = "name by which modules and sensors ask for the camera"});
  v("width", c.width_px, {.unit = "px", .at_least = 8, .at_most = 8192, .meaning = "columns of the picture"});
  v("height", c.height_px, {.unit = "px", .at_least = 8, .at_most = 8192, .meaning = "rows of the picture"});
  v("fov", c.fov_rad, {.unit = "deg", .above = 0.0, .below = 180.0, .meaning = "horizontal field of view"});
  v("rate", c.rate_hz, {.unit = "Hz", .above = 0.0, .meaning = "pictures a second; divides the physics rate"});
  v("channel", c.channel, {.choices = {"grey", "color", "depth"}, .meaning = "what a pixel holds"});
  v("forward", c.forward_m, {.unit = "m", .meaning = "mounting position ahead of the body's origin"});
  v("right", c.right_m, {.unit = "m", .meaning = "mounting position right of the body's origin"});
  v("down", c.down_m, {.unit = "m", .meaning = "mounting position below the body's origin"});
  v("yaw", c.yaw_rad, {.unit = "deg", .at_least = -180.0, .at_most = 180.0, .meaning = "turn to the right, first"});
  v("pitch", c.pitch_rad, {.unit = "deg", .at_least = -90.0, .at_most = 90.0, .meaning = "turn upwards, second"});
  v("roll", c.roll_rad, {.unit = "deg", .at_least = -180.0, .at_most = 180.0, .meaning = "turn clockwise, last"});
}

/// The cameras a vehicle carries.
struct RigConfig {
  std::vector<CameraConfig> cameras;

  /// The camera of a role, or null.
  const CameraConfig* find(std::string_view role) const;
};

template <class Visitor>
void describe(Visitor& v, RigConfig& c) {
  v("cameras", c.cameras, {.meaning = "cameras, each of its own role"});
}

}  // namespace hedgehop::sim
