#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "avoidance/camera_channel.h"
#include "sim/fields/field.h"
#include "sim/scenario/imperfections.h"
#include "vision/camera/camera.h"

namespace hedgehop::sim {

/// One camera as mounted on the vehicle. All angles zero: looks along B's x, its u axis along B's y.
struct CameraConfig {
  using Channel = avoidance::CameraChannel;
  enum class Model { pinhole, fisheye, ocam };

  std::string role;
  Model model_kind = Model::pinhole;
  int width_px = 400, height_px = 400;
  double fov_rad = std::numbers::pi / 2.0;
  std::optional<double> focal_x_px, focal_y_px, center_u_px, center_v_px;
  std::vector<double> distortion;
  std::optional<double> view_limit_rad;
  std::filesystem::path calibration;
  double rate_hz = 50.0;
  Channel channel = Channel::grey;
  double corner_noise_px = 0.5;  ///< of a corner detector that works well
  int samples = 1;               ///< samples in each pixel, averaged for grey and color: 1, 2, 4 or 8
  double forward_m = 0.0, right_m = 0.0, down_m = 0.0;
  double yaw_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;
  double row_error_px = 0.0, side_error_m = 0.0;     ///< of the calibration; the signs are drawn by the seed
  std::optional<ImperfectionsConfig> imperfections;  ///< none: the rig's sensor, where it is for the channel

  /// Pose of the camera in B as its calibration has it: the mounting position, and yaw about down, pitch about right,
  /// roll about forward, in that order, applied to a camera that looks forward. Yaw 90 deg looks right, pitch -90 deg
  /// looks down.
  Eigen::Isometry3d X_BC() const;
  /// Throws std::invalid_argument that begins with the key at fault, for values out of bounds, keys that do not go
  /// together or a calibration file that cannot be used.
  vision::camera::Camera model() const;
  /// Whether the lens is an undistorted pinhole.
  bool is_undistorted_pinhole() const;
};

/// All keys of a camera but its role.
template <class Visitor>
void describe_without_role(Visitor& v, CameraConfig& c) {
  v("model", c.model_kind,
    {.choices = {"pinhole", "fisheye", "ocam"},
     .meaning = "perspective; equidistant fisheye; omnidirectional, from a file of OCamCalib"});
  v("width", c.width_px, {.unit = "px", .at_least = 8, .at_most = 8192, .meaning = "columns of the image"});
  v("height", c.height_px, {.unit = "px", .at_least = 8, .at_most = 8192, .meaning = "rows of the image"});
  v("fov", c.fov_rad,
    {.unit = "deg",
     .above = 0.0,
     .below = 360.0,
     .meaning = "horizontal field of view, less than 180 for a pinhole; focal_x takes its place"});
  v("focal_x", c.focal_x_px, {.unit = "px", .above = 0.0, .meaning = "focal length along a row; else from fov"});
  v("focal_y", c.focal_y_px, {.unit = "px", .above = 0.0, .meaning = "focal length along a column; else focal_x"});
  v("center_u", c.center_u_px, {.unit = "px", .meaning = "column of the optical axis; else the middle"});
  v("center_v", c.center_v_px, {.unit = "px", .meaning = "row of the optical axis; else the middle"});
  v("distortion", c.distortion, {.meaning = "as OpenCV has it: k1 k2 p1 p2 k3 of a pinhole, k1 k2 k3 k4 of a fisheye"});
  v("view_limit", c.view_limit_rad,
    {.unit = "deg",
     .above = 0.0,
     .at_most = 180.0,
     .meaning = "angle off the axis where a fisheye's image ends; else as far as its lens goes"});
  v("calibration", c.calibration, {.meaning = "file calib_results.txt of OCamCalib, for model: ocam"});
  v("rate", c.rate_hz,
    {.unit = "Hz", .at_least = fields::kSlowestHz, .meaning = "images a second; divides the physics rate"});
  v("channel", c.channel,
    {.choices = {"grey", "color", "depth", "corners"},
     .meaning = "what a pixel holds; or corners, from an ideal detector of the scene's known corners: truth, for an "
                "experiment"});
  v("corner_noise", c.corner_noise_px,
    {.unit = "px", .at_least = 0.0, .meaning = "of channel corners: standard deviation of a position, per axis"});
  v("samples", c.samples,
    {.at_least = 1,
     .at_most = 8,
     .meaning =
         "places in each pixel that grey and color are the mean of: 1, 2, 4 or 8; refused where the OpenGL at hand "
         "has others (Mesa's rasterizer: 1 and 4)"});
  v("forward", c.forward_m, {.unit = "m", .meaning = "mounting position ahead of the body's origin"});
  v("right", c.right_m, {.unit = "m", .meaning = "mounting position right of the body's origin"});
  v("down", c.down_m, {.unit = "m", .meaning = "mounting position below the body's origin"});
  v("yaw", c.yaw_rad, {.unit = "deg", .at_least = -180.0, .at_most = 180.0, .meaning = "rotation to the right, first"});
  v("pitch", c.pitch_rad, {.unit = "deg", .at_least = -90.0, .at_most = 90.0, .meaning = "rotation upwards, second"});
  v("roll", c.roll_rad, {.unit = "deg", .at_least = -180.0, .at_most = 180.0, .meaning = "rotation clockwise, last"});
  v("imperfections", c.imperfections,
    {.meaning = "noise, blur, rolling shutter and faults; none unless given here or, for grey and color, by the rig's "
                "sensor"});
}

template <class Visitor>
void describe(Visitor& v, CameraConfig& c) {
  v("role", c.role, {.required = true, .meaning = "name by which modules and sensors refer to the camera"});
  v("row_error", c.row_error_px,
    {.unit = "px",
     .at_least = 0.0,
     .at_most = 100.0,
     .meaning = "error of the calibration: rows by which its image is truly higher or lower, by the seed"});
  v("side_error", c.side_error_m,
    {.unit = "m",
     .at_least = 0.0,
     .meaning =
         "error of the calibration: how far along its rows it truly sits, to one side or the other by the seed"});
  describe_without_role(v, c);
}

/// Two equal cameras, parallel and side by side along their rows as they are calibrated. The errors of the calibration
/// are those of the right camera.
struct StereoConfig {
  std::string role;
  double baseline_m = 0.3;
  double row_error_px = 0.0;
  double baseline_error = 0.0;  ///< share of the baseline
  CameraConfig camera;          ///< its mounting position is the middle of the pair
};

template <class Visitor>
void describe(Visitor& v, StereoConfig& c) {
  v("role", c.role, {.meaning = "the cameras are <role>_left and <role>_right; left and right when empty"});
  v("baseline", c.baseline_m,
    {.unit = "m", .above = 0.0, .meaning = "distance between the two; each half of it aside"});
  v("row_error", c.row_error_px,
    {.unit = "px",
     .at_least = 0.0,
     .at_most = 100.0,
     .meaning = "error of the calibration: rows by which the right image is truly higher or lower, by the seed"});
  v("baseline_error", c.baseline_error,
    {.at_least = 0.0,
     .at_most = 1.0,
     .meaning = "error of the calibration: share by which the baseline is truly longer or shorter, by the seed"});
  describe_without_role(v, c.camera);
}

/// The cameras of a vehicle.
struct RigConfig {
  std::vector<CameraConfig> cameras;
  std::vector<StereoConfig> stereo;
  std::optional<ImperfectionsConfig> sensor;  ///< of every grey or color camera that states no imperfections

  /// The camera of a role, or null.
  const CameraConfig* find(std::string_view role) const;
  /// In words, what is amiss for one who needs a camera with this role and channel, and, with `pinhole`, an undistorted
  /// pinhole; empty where nothing is.
  std::vector<std::string> lacks(std::string_view role, CameraConfig::Channel channel, bool pinhole) const;
};

template <class Visitor>
void describe(Visitor& v, RigConfig& c) {
  v("cameras", c.cameras, {.meaning = "cameras, each of its own role"});
  v("stereo", c.stereo, {.meaning = "pairs, each two more cameras; a resolved scenario lists them as such"});
  v("sensor", c.sensor,
    {.meaning = "imperfections of every grey or color camera that states none; a resolved scenario lists them there"});
}

/// Replaces every pair by its two cameras, left before right, after the other cameras.
void mount_stereo_pairs(RigConfig& rig);

/// Gives the rig's sensor to every grey or color camera that states no imperfections; call it with the pairs mounted.
void mount_sensor(RigConfig& rig);

}  // namespace hedgehop::sim
