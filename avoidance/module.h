#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "avoidance/camera_channel.h"
#include "vision/camera/camera.h"

/// The only interface between an avoidance module and its aircraft. A module receives images and the navigation
/// estimate of the aircraft, never the truth. Frames (CONTRIBUTING.md): W north-east-down, B forward-right-down, C
/// right-down-forward. SI units, radians.
namespace hedgehop::avoidance {

/// The aircraft's estimate of its own motion, from noisy sensors.
struct NavigationState {
  Eigen::Vector3d p_WB_est = Eigen::Vector3d::Zero();            ///< position of B in W, m
  Eigen::Quaterniond q_WB_est = Eigen::Quaterniond::Identity();  ///< attitude of B in W
  Eigen::Vector3d v_WB_B_est = Eigen::Vector3d::Zero();          ///< velocity of B in W, expressed in B, m/s
  Eigen::Vector3d w_WB_B_est = Eigen::Vector3d::Zero();          ///< angular velocity (gyro less bias), rad/s
  /// Attitude integrated from the gyros alone. It drifts but contains no corrections. Use it for the rotation between
  /// two instants.
  Eigen::Quaterniond q_WB_gyro = Eigen::Quaterniond::Identity();
  double height_above_ground_m = 0.0;  ///< from the height sensor, >= 0
  /// From a range finder fixed to B, >= 0; empty if it has no reading or is not fitted.
  std::optional<double> range_m;
};

/// The end of the flight.
struct Goal {
  Eigen::Vector3d p_WG = Eigen::Vector3d::Zero();  ///< position in W, m
  double heading_rad = 0.0;                        ///< heading to hold, from north to east
};

/// One image, valid during the call that receives it.
struct CameraFrame {
  std::string role;  ///< "front", "left", ... as the rig names it
  int64_t t_ns = 0;  ///< instant of exposure
  /// rows x cols; CV_8UC1 grey, CV_8UC3 RGB, CV_32FC1 depth, m (z in C, of a fisheye the range; NaN if unknown). From a
  /// corner detector: N x 1, CV_64FC2, the positions (u, v) of N >= 0 corners, px.
  cv::Mat image;
};

struct Observation {
  int64_t t_ns = 0;  ///< current time; frames may be older
  std::span<const CameraFrame> frames;
  NavigationState navigation;
  Goal goal;
};

/// Flies at a horizontal velocity and holds an altitude and a heading.
struct VelocityCommand {
  Eigen::Vector2d v_WB_W = Eigen::Vector2d::Zero();  ///< north, east, m/s
  double altitude_m = 0.0;                           ///< above W's origin, positive up
  double heading_rad = 0.0;                          ///< from north to east
};
/// Flies to a point and holds it.
struct PositionCommand {
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();  ///< m
  double heading_rad = 0.0;
};
/// Holds an attitude and an altitude.
struct AttitudeCommand {
  double roll_rad = 0.0, pitch_rad = 0.0, heading_rad = 0.0, altitude_m = 0.0;
};
/// Stops, holds the position and turns at `yaw_rate_radps`.
struct HoverCommand {
  double yaw_rate_radps = 0.0;
};
using Command = std::variant<VelocityCommand, PositionCommand, AttitudeCommand, HoverCommand>;
/// The types of Command, in its order.
enum class CommandType { velocity, position, attitude, hover };
inline CommandType type_of(const Command& command) { return static_cast<CommandType>(command.index()); }

/// Scales a speed above the limit down to the limit. Throws std::invalid_argument if the command is not finite.
/// @param speed_limit_mps  > 0.
void confine(Command& command, double speed_limit_mps);

/// A camera that a module requires.
struct CameraNeed {
  std::string role;
  using Channel = avoidance::CameraChannel;
  Channel channel = Channel::grey;
  bool pinhole = false;  ///< the module supports only an undistorted pinhole
};
struct Needs {
  std::vector<CameraNeed> cameras;
  /// Types of the commands that the module gives; a hover needs no entry. Empty: not declared. A link to an autopilot
  /// that does not accept a declared type refuses the module before the flight.
  std::vector<CommandType> commands = {};
};

/// A mounted camera: model and pose in B.
struct MountedCamera {
  std::string role;
  vision::camera::Camera model;
  Eigen::Isometry3d X_BC = Eigen::Isometry3d::Identity();
  double rate_hz = 0.0;  ///< > 0
};
struct VehicleLimits {
  double speed_mps = 0.0, acceleration_mps2 = 0.0;
  double radius_m = 0.0;  ///< radius of the smallest vertical cylinder around B that contains the vehicle
  /// Boxes in B that together contain the hull, m: a helicopter's rotor, fuselage and boom; empty if only the radius is
  /// known.
  std::vector<Eigen::AlignedBox3d> outline_B;
};
/// Altitudes that are allowed in the mission, above the origin of W, positive up, m.
struct AltitudeBand {
  double min_m = 0.0, max_m = 0.0;
};
struct Setup {
  std::vector<MountedCamera> cameras;
  VehicleLimits limits;
  uint64_t seed = 0;
  std::optional<AltitudeBand> altitude_band;  ///< empty: the mission holds the altitude of the start or of the goal
};

/// Returns the camera of a role, null if the rig has none.
const MountedCamera* find_camera(const Setup& setup, std::string_view role);
/// The same. Throws std::invalid_argument if the rig has none.
const MountedCamera& required_camera(const Setup& setup, std::string_view role);
/// Returns the image of a role, null if there is none at this instant.
const CameraFrame* find_frame(std::span<const CameraFrame> frames, std::string_view role);

/// A column that a module adds to decisions.csv.
struct Signal {
  std::string name;  ///< snake_case, with its unit: "flow_left_radps"
  std::string unit;
};
struct Metric {
  std::string name;
  double value = 0.0;
  std::string unit;
  bool is_wall_time = false;  ///< differs from run to run
};

struct Decision {
  Command command;
  std::string status;           ///< one word: "cruise", "avoid", ...
  std::vector<double> signals;  ///< in the order of signals(); NaN if unknown
};

/// An estimated point of the world.
struct MapPoint {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();           ///< m
  Eigen::Matrix3d covariance_W = Eigen::Matrix3d::Zero();  ///< m^2
};
/// A module's estimate of the world and its path. North and east, m.
struct Map {
  std::vector<MapPoint> points;
  std::vector<Eigen::Vector2d>
      course_NE;  ///< corners of the course of the mission, which the vehicle follows if it is free
  std::vector<Eigen::Vector2d> path_NE;  ///< corners of the planned path from the current position, with its end
};

/// Base class of all modules. The public functions check arguments and results; the private virtual functions implement
/// the module.
class Module {
 public:
  virtual ~Module() = default;

  /// Cameras that the module requires; available before reset().
  Needs needs() const { return do_needs(); }
  /// Columns of Decision::signals; constant during the life of a module.
  std::vector<Signal> signals() const { return do_signals(); }

  /// Starts a flight. The module then behaves like a newly constructed one. Throws std::invalid_argument if a required
  /// camera is missing, if its lens is not supported, or if its rate or the speed limit is not positive.
  void reset(const Setup& setup);

  /// Returns the decision for an observation. A speed above the limit is scaled down to the limit. Throws
  /// std::logic_error
  /// - if reset() was not called or time does not increase;
  /// - if navigation or goal are not finite;
  /// - if a frame is of a camera that reset() did not name, is from the future, or does not have the size of its camera
  /// or the required channel (corners have no size);
  /// - if do_update() returns a command that is not finite or of a type that the module does not declare, or the wrong
  /// number of signals.
  Decision update(const Observation& observation);

  /// Metrics of the flight so far, for result.json.
  std::vector<Metric> metrics() const { return do_metrics(); }
  /// The current map; empty if the module has none.
  Map map() const { return do_map(); }
  /// Returns an image (CV_8UC3, RGB) of the last input and decision; empty if there is none. Called only for videos.
  cv::Mat annotate() const { return do_annotate(); }

 private:
  virtual Needs do_needs() const = 0;
  virtual std::vector<Signal> do_signals() const { return {}; }
  virtual void do_reset(const Setup& setup) = 0;
  virtual Decision do_update(const Observation& observation) = 0;
  virtual std::vector<Metric> do_metrics() const { return {}; }
  virtual Map do_map() const { return {}; }
  virtual cv::Mat do_annotate() const { return {}; }

  std::optional<Setup> setup_;
  Needs needs_;
  std::optional<int64_t> last_t_ns_;
  size_t signal_count_ = 0;
};

}  // namespace hedgehop::avoidance
