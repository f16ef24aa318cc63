#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "avoidance/camera_channel.h"
#include "sim/fields/field.h"
#include "vision/camera/camera.h"

namespace hedgehop::sim {

/// Imperfections of a real camera's images. All are off by default. Numbers are per camera, drawn from its own stream.
/// Those of light, lens and sensor are for grey and color, disparity noise for depth, frame faults and readout for all.
struct ImperfectionsConfig {
  /// Of the stereo pair that a depth camera stands for: [Andert2007] sec. 2. It turns disparity noise into depth noise.
  static constexpr double kBaselineM = 0.3;

  double vignetting = 0.0;          ///< share of brightness missing in the corner
  double exposure_stops = 0.0;      ///< brighter (> 0) or darker than drawn, in powers of two
  double auto_exposure_s = 0.0;     ///< time constant that draws the mean to mid-grey; 0: off
  double full_well = 0.0;           ///< photo-electrons at white; 0: no photon noise
  double read_noise = 0.0;          ///< standard deviation, grey levels
  double fixed_pattern = 0.0;       ///< standard deviation of the pixels' gains, constant over a flight
  double disparity_noise_px = 0.0;  ///< standard deviation, of focal length times kBaselineM over depth
  double shutter_s = 0.0;           ///< exposure time
  int shutter_samples = 8;          ///< maximum number of moments averaged for motion blur
  double readout_s = 0.0;           ///< from the first row's exposure to the last's; 0: global shutter
  int readout_strips = 16;          ///< of rows that share a moment
  double drop = 0.0;                ///< probability that an image is lost
  double freeze = 0.0;              ///< probability that the last image is delivered again
  double black = 0.0;               ///< probability that an image is black
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<ImperfectionsConfig> auto& c) {
  v("vignetting", c.vignetting,
    {.at_least = 0.0, .at_most = 1.0, .meaning = "share of the brightness that is missing in the image's corners"});
  v("exposure", c.exposure_stops,
    {.at_least = -10.0,
     .at_most = 10.0,
     .meaning = "stops by which images are brighter than rendered; white saturates"});
  v("auto_exposure", c.auto_exposure_s,
    {.unit = "s",
     .at_least = 0.0,
     .meaning = "time constant of the control of mean brightness to mid-grey; 0: fixed exposure"});
  v("full_well", c.full_well,
    {.at_least = 0.0, .meaning = "photo-electrons of a white pixel, for photon noise; 0: no photon noise"});
  v("read_noise", c.read_noise,
    {.at_least = 0.0, .at_most = 255.0, .meaning = "standard deviation of the read noise, in grey levels of 255"});
  v("fixed_pattern", c.fixed_pattern,
    {.at_least = 0.0,
     .at_most = 1.0,
     .meaning = "standard deviation of the pixels' gains (photo-response nonuniformity), constant over a flight"});
  v("disparity_noise", c.disparity_noise_px,
    {.unit = "px",
     .at_least = 0.0,
     .at_most = 100.0,
     .meaning = "standard deviation of a depth camera's noise, as disparity of a pair with a baseline of 0.3 m"});
  v("shutter", c.shutter_s,
    {.unit = "s", .at_least = 0.0, .at_most = 1.0, .meaning = "exposure time, which ends at the instant of the image"});
  v("shutter_samples", c.shutter_samples,
    {.at_least = 1,
     .at_most = 256,
     .meaning = "maximum number of moments averaged for motion blur; within it they are at most 0.4 pixels apart"});
  v("readout", c.readout_s,
    {.unit = "s",
     .at_least = 0.0,
     .at_most = 1.0,
     .meaning = "from the first row to the last, which is read at the "
                "image's instant; 0: global shutter"});
  v("readout_strips", c.readout_strips,
    {.at_least = 2, .at_most = 4096, .meaning = "strips of rows that a rolling shutter reads at one moment each"});
  v("drop", c.drop, {.at_least = 0.0, .at_most = 1.0, .meaning = "probability that an image is lost"});
  v("freeze", c.freeze,
    {.at_least = 0.0, .at_most = 1.0, .meaning = "probability that the last image is delivered again"});
  v("black", c.black, {.at_least = 0.0, .at_most = 1.0, .meaning = "probability that an image is black"});
}

/// One camera as mounted on the vehicle. All angles zero: looks along B's x, its u axis along B's y.
struct CameraConfig {
  using Channel = avoidance::CameraChannel;
  enum class Model { pinhole, fisheye, ocam, unified, double_sphere };

  std::string role;
  Model model_kind = Model::pinhole;
  int width_px = 400, height_px = 400;
  double fov_rad = std::numbers::pi / 2.0;
  std::optional<double> focal_x_px, focal_y_px, center_u_px, center_v_px;
  std::vector<double> distortion;
  std::optional<double> view_limit_rad;
  std::optional<double> xi, alpha;  ///< of a unified and a double-sphere lens
  std::filesystem::path calibration;
  std::string calibration_camera;
  double rate_hz = 50.0;
  Channel channel = Channel::grey;
  double corner_noise_px = 0.5;  ///< typical of a good corner detector
  int samples = 1;               ///< samples per pixel, averaged for grey and color: 1, 2, 4 or 8
  double forward_m = 0.0, right_m = 0.0, down_m = 0.0;
  double yaw_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;
  std::vector<double> quaternion;  ///< of R_BC: w, x, y, z; instead of the angles
  /// The pose as 16 numbers of a 4 x 4 matrix, row by row, as a calibration states it: X_BC, X_FC or X_CF (F is the
  /// IMU's frame, sim/scenario/calibration.h). At most one is not empty, and it replaces position and angles.
  std::vector<double> body_from_camera, imu_from_camera, camera_from_imu;
  std::vector<double> camera_from_previous;          ///< X_CCp of a chain; mount_rig() replaces it by body_from_camera
  Eigen::Vector3d p_BI_m = Eigen::Vector3d::Zero();  ///< position of the IMU, set by mount_rig()
  double row_error_px = 0.0, side_error_m = 0.0;     ///< of the calibration; the signs are drawn by the seed
  std::optional<ImperfectionsConfig> imperfections;  ///< none: the rig's sensor, for grey and color

  /// Returns the calibrated pose of the camera in B: that of its matrix, or the mounting position, and the quaternion,
  /// or yaw about down, pitch about right, roll about forward, in this order, from a camera that looks forward. Yaw 90
  /// deg looks right, pitch -90 deg looks down. Throws fields::InvalidField for a matrix or quaternion that is no pose,
  /// and for a pose that is stated twice.
  Eigen::Isometry3d X_BC() const;
  /// Throws fields::InvalidField for values out of bounds, keys that contradict each other, or an invalid calibration
  /// file.
  vision::camera::Camera model() const;
  /// Whether the lens is an undistorted pinhole.
  bool is_undistorted_pinhole() const;
};

/// Lists all keys of a camera except its role.
template <class Visitor>
void describe_without_role(Visitor& v, fields::ConfigOf<CameraConfig> auto& c) {
  v("model", c.model_kind,
    {.choices = {"pinhole", "fisheye", "ocam", "unified", "double_sphere"},
     .meaning = "perspective; equidistant fisheye; omnidirectional, from a file of OCamCalib; unified (Mei); double "
                "sphere"});
  v("width", c.width_px, {.unit = "px", .at_least = 8, .at_most = 8192, .meaning = "columns of the image"});
  v("height", c.height_px, {.unit = "px", .at_least = 8, .at_most = 8192, .meaning = "rows of the image"});
  v("fov", c.fov_rad,
    {.unit = "deg",
     .above = 0.0,
     .below = 360.0,
     .meaning = "horizontal field of view, less than 180 for a pinhole; ignored with focal_x"});
  v("focal_x", c.focal_x_px, {.unit = "px", .above = 0.0, .meaning = "focal length along a row; default: from fov"});
  v("focal_y", c.focal_y_px, {.unit = "px", .above = 0.0, .meaning = "focal length along a column; default: focal_x"});
  v("center_u", c.center_u_px, {.unit = "px", .meaning = "column of the optical axis; default: the center"});
  v("center_v", c.center_v_px, {.unit = "px", .meaning = "row of the optical axis; default: the center"});
  v("distortion", c.distortion,
    {.meaning = "coefficients of OpenCV: k1 k2 p1 p2 k3 of a pinhole, or with k4 k5 k6 (rational); k1 k2 k3 k4 of a "
                "fisheye; k1 k2 p1 p2 of a unified lens"});
  v("xi", c.xi, {.above = -1.0, .meaning = "parameter of a unified (>= 0) or double-sphere lens"});
  v("alpha", c.alpha, {.at_least = 0.0, .below = 1.0, .meaning = "parameter of a double-sphere lens"});
  v("view_limit", c.view_limit_rad,
    {.unit = "deg",
     .above = 0.0,
     .at_most = 180.0,
     .meaning = "angle from the axis at which a fisheye's image ends; default: the limit of its lens"});
  v("calibration", c.calibration,
    {.meaning =
         "calibration file, instead of the keys of lens, size and pose: Kalibr, sensor.yaml of EuRoC, camera_info "
         "of ROS, OpenCV (YAML or XML), OCamCalib"});
  v("calibration_camera", c.calibration_camera,
    {.meaning = "camera in a file with several, such as cam1; default: the one with the camera's role"});
  v("rate", c.rate_hz,
    {.unit = "Hz", .at_least = fields::kMinRateHz, .meaning = "image rate; must divide the physics rate"});
  v("channel", c.channel,
    {.choices = {"grey", "color", "depth", "corners"},
     .meaning = "pixel content; corners are ground truth from an ideal detector of the scene's known corners, for "
                "experiments"});
  v("corner_noise", c.corner_noise_px,
    {.unit = "px",
     .at_least = 0.0,
     .meaning = "standard deviation of a corner position per axis, for channel corners"});
  v("samples", c.samples,
    {.at_least = 1,
     .at_most = 8,
     .meaning =
         "samples per pixel of grey and color: 1, 2, 4 or 8; refused if the renderer does not support the number "
         "(Mesa's rasterizer: 1 and 4)"});
  v("forward", c.forward_m, {.unit = "m", .meaning = "mounting position ahead of the body's origin"});
  v("right", c.right_m, {.unit = "m", .meaning = "mounting position right of the body's origin"});
  v("down", c.down_m, {.unit = "m", .meaning = "mounting position below the body's origin"});
  v("yaw", c.yaw_rad, {.unit = "deg", .at_least = -180.0, .at_most = 180.0, .meaning = "rotation to the right, first"});
  v("pitch", c.pitch_rad, {.unit = "deg", .at_least = -90.0, .at_most = 90.0, .meaning = "rotation upwards, second"});
  v("roll", c.roll_rad, {.unit = "deg", .at_least = -180.0, .at_most = 180.0, .meaning = "rotation clockwise, last"});
  v("quaternion", c.quaternion,
    {.meaning = "w x y z of the rotation from the camera's axes (right, down, forward) to the body's (forward, right, "
                "down), instead of yaw, pitch and roll"});
  v("body_from_camera", c.body_from_camera,
    {.meaning = "pose of the camera in the body as a 4 x 4 matrix, row by row, instead of position and angles"});
  v("imu_from_camera", c.imu_from_camera,
    {.meaning = "the same in the frame of the IMU (forward, left, up), as T_BS of EuRoC"});
  v("camera_from_imu", c.camera_from_imu, {.meaning = "the inverse of imu_from_camera, as T_cam_imu of Kalibr"});
  v("imperfections", c.imperfections,
    {.meaning =
         "noise, blur, rolling shutter and frame faults; default: for grey and color, those of the rig's sensor"});
}

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<CameraConfig> auto& c) {
  v("role", c.role, {.required = true, .meaning = "name by which modules and sensors refer to the camera"});
  v("row_error", c.row_error_px,
    {.unit = "px",
     .at_least = 0.0,
     .at_most = 100.0,
     .meaning = "calibration error: rows by which the true image is higher or lower; the seed draws the sign"});
  v("side_error", c.side_error_m,
    {.unit = "m",
     .at_least = 0.0,
     .meaning = "calibration error: true displacement along the rows; the seed draws the sign"});
  describe_without_role(v, c);
}

/// Two equal parallel cameras, displaced along their rows as calibrated. The calibration errors are those of the right
/// camera.
struct StereoConfig {
  std::string role;
  double baseline_m = 0.3;
  double row_error_px = 0.0;
  double baseline_error = 0.0;  ///< share of the baseline
  CameraConfig camera;          ///< its pose is that of the middle of the pair
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<StereoConfig> auto& c) {
  v("role", c.role, {.meaning = "prefix of the roles <role>_left and <role>_right; left and right if empty"});
  v("baseline", c.baseline_m, {.unit = "m", .above = 0.0, .meaning = "distance between the two cameras"});
  v("row_error", c.row_error_px,
    {.unit = "px",
     .at_least = 0.0,
     .at_most = 100.0,
     .meaning = "calibration error: rows by which the true right image is higher or lower; the seed draws the sign"});
  v("baseline_error", c.baseline_error,
    {.at_least = 0.0,
     .at_most = 1.0,
     .meaning = "calibration error: share by which the true baseline is longer or shorter; the seed draws the sign"});
  describe_without_role(v, c.camera);
}

/// The cameras of a vehicle.
struct RigConfig {
  std::vector<CameraConfig> cameras;
  std::vector<StereoConfig> stereo;
  std::optional<ImperfectionsConfig> sensor;  ///< of every grey or color camera without imperfections
  std::filesystem::path calibration;
  std::vector<std::filesystem::path> read_calibrations;  ///< files whose content is now in the cameras' keys

  /// Returns the camera of a role, or null.
  const CameraConfig* find(std::string_view role) const;
  /// Returns the cameras of the roles of `--camera`, in this order. Throws InputError for a role that the rig lacks or
  /// that occurs twice.
  std::vector<CameraConfig> select(const std::vector<std::string>& roles) const;
  /// Returns why the rig does not fulfil a need of a camera with this role and channel and, with `pinhole`, an
  /// undistorted pinhole; empty if it does.
  std::vector<std::string> lacks(std::string_view role, CameraConfig::Channel channel, bool pinhole) const;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<RigConfig> auto& c) {
  v("cameras", c.cameras, {.meaning = "cameras, each with a unique role"});
  v("stereo", c.stereo, {.meaning = "stereo pairs; a resolved scenario lists their cameras"});
  v("sensor", c.sensor,
    {.meaning = "imperfections of every grey or color camera without its own; a resolved scenario lists them there"});
  v("calibration", c.calibration,
    {.meaning = "calibration file of several cameras, as for a camera; cameras of the rig with the role or name of an "
                "entry take it, other entries become cameras"});
}

/// Applies calibration files (sim/scenario/calibration_file.h); replaces every stereo pair by its two cameras, left
/// before right, after the other cameras; then gives the rig's sensor to every grey or color camera without
/// imperfections of its own. Has no effect on a mounted rig. @param p_BI_m  position of the IMU in B. Throws
/// fields::InvalidField for a calibration that cannot be used.
void mount_rig(RigConfig& rig, const Eigen::Vector3d& p_BI_m = Eigen::Vector3d::Zero());

/// Returns the angle that one pixel spans along a column at the optical axis, rad: 1 over the focal length in px.
double pixel_angle_rad(const vision::camera::Camera& camera);

/// Returns the true pose of a camera in B: the calibrated pose, CameraConfig::X_BC(), with its errors. `side_error`
/// moves the camera along its rows; `row_error` rotates it about them, which shifts distant points by that many rows at
/// the optical axis.
/// @param model  of the camera. @param seed  of the flight: the camera's own stream decides both signs.
Eigen::Isometry3d true_X_BC(const CameraConfig& camera, const vision::camera::Camera& model, uint64_t seed);

}  // namespace hedgehop::sim
