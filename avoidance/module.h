#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "avoidance/camera_channel.h"
#include "vision/camera/camera.h"

/// The one interface between an avoidance module and the aircraft that carries it. A module sees images and the
/// aircraft's own navigation, never truth. Frames (CONTRIBUTING.md): W north-east-down, B forward-right-down,
/// C right-down-forward. SI units, radians.
namespace hedgehop::avoidance {

/// The aircraft's estimate of its own motion, from its noisy sensors.
struct NavigationState {
  Eigen::Vector3d p_WB_est = Eigen::Vector3d::Zero();            ///< position of B in W, m
  Eigen::Quaterniond q_WB_est = Eigen::Quaterniond::Identity();  ///< attitude of B in W
  Eigen::Vector3d v_WB_B_est = Eigen::Vector3d::Zero();          ///< velocity of B in W, expressed in B, m/s
  Eigen::Vector3d w_WB_B_est = Eigen::Vector3d::Zero();          ///< angular velocity (gyro less bias), rad/s
  /// Attitude by the gyros alone. It drifts, but no correction rotates it: for rotations between two instants.
  Eigen::Quaterniond q_WB_gyro = Eigen::Quaterniond::Identity();
  double height_above_ground_m = 0.0;  ///< from the height sensor, >= 0
  std::optional<double>
      range_m;  ///< from a range finder fixed to B, >= 0; unknown when it read nothing, or there is none
};

/// Where the flight should end.
struct Goal {
  Eigen::Vector3d p_WG = Eigen::Vector3d::Zero();  ///< position in W, m
  double heading_rad = 0.0;                        ///< heading to hold, from north to east
};

/// One image, valid during the call that receives it.
struct CameraFrame {
  std::string role;  ///< "front", "left", ... as the rig names it
  int64_t t_ns = 0;  ///< instant of exposure
  /// rows x cols; CV_8UC1 grey, CV_8UC3 RGB, CV_32FC1 depth (z in C, fisheye: range; m; or NaN). Of a corner detector
  /// N x 1, CV_64FC2: the positions (u, v) of N >= 0 corners, px.
  cv::Mat image;
};

struct Observation {
  int64_t t_ns = 0;  ///< now; frames may be older
  std::span<const CameraFrame> frames;
  NavigationState navigation;
  Goal goal;
};

/// Fly at a horizontal velocity, hold a height and a heading.
struct VelocityCommand {
  Eigen::Vector2d v_WB_W = Eigen::Vector2d::Zero();  ///< north, east, m/s
  double altitude_m = 0.0;                           ///< above W's origin, positive up
  double heading_rad = 0.0;                          ///< from north to east
};
/// Fly to a point and stay there.
struct PositionCommand {
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();  ///< m
  double heading_rad = 0.0;
};
/// Hold an attitude and a height.
struct AttitudeCommand {
  double roll_rad = 0.0, pitch_rad = 0.0, heading_rad = 0.0, altitude_m = 0.0;
};
/// Stop and stay; turn at `yaw_rate_radps`.
struct HoverCommand {
  double yaw_rate_radps = 0.0;
};
using Command = std::variant<VelocityCommand, PositionCommand, AttitudeCommand, HoverCommand>;

/// Scales a speed above the limit down to it. Throws std::invalid_argument when the command is not finite.
/// @param speed_limit_mps  > 0.
void confine(Command& command, double speed_limit_mps);

/// A camera a module cannot fly without.
struct CameraNeed {
  std::string role;
  using Channel = avoidance::CameraChannel;
  Channel channel = Channel::grey;
  bool pinhole = false;  ///< the module's mathematics holds for an undistorted pinhole only
};
struct Needs {
  std::vector<CameraNeed> cameras;
};

/// A camera as mounted: model and pose in B.
struct MountedCamera {
  std::string role;
  vision::camera::Camera model;
  Eigen::Isometry3d X_BC = Eigen::Isometry3d::Identity();
  double rate_hz = 0.0;  ///< > 0
};
struct VehicleLimits {
  double speed_mps = 0.0, acceleration_mps2 = 0.0;
  double radius_m = 0.0;  ///< of the smallest vertical cylinder round B that holds the vehicle
  /// Boxes in B that together hold the hull, m: a helicopter's rotor, fuselage and boom; empty where only the radius is
  /// known.
  std::vector<Eigen::AlignedBox3d> outline_B;
};
/// Altitudes that a mission may fly at, above W's origin, positive up, m.
struct AltitudeBand {
  double min_m = 0.0, max_m = 0.0;
};
struct Setup {
  std::vector<MountedCamera> cameras;
  VehicleLimits limits;
  uint64_t seed = 0;
  std::optional<AltitudeBand> altitude_band;  ///< none: the mission keeps the height of the start or of the goal
};

/// One column a module adds to decisions.csv.
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
  std::vector<double> signals;  ///< in the order of signals(); NaN where unknown
};

/// An estimated point of the world.
struct MapPoint {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();           ///< m
  Eigen::Matrix3d covariance_W = Eigen::Matrix3d::Zero();  ///< m^2
};
/// A module's estimate of the world, and its path through it. North and east, m.
struct Map {
  std::vector<MapPoint> points;
  std::vector<Eigen::Vector2d> course_NE;  ///< the mission's, point by point: to be kept where it is free
  std::vector<Eigen::Vector2d> path_NE;    ///< planned from here, turn by turn, its end included
};

/// Base of all modules: the public functions check, the private ones work (override only those).
class Module {
 public:
  virtual ~Module() = default;

  /// Cameras the module needs, known before reset().
  Needs needs() const { return do_needs(); }
  /// Columns of Decision::signals; constant over a module's life.
  std::vector<Signal> signals() const { return do_signals(); }

  /// Starts a flight; afterwards the module behaves as one newly made.
  /// Throws std::invalid_argument when a needed camera is missing or has a lens that the module cannot do
  /// with, or when its rate or the speed limit is not positive.
  void reset(const Setup& setup);

  /// Returns the decision for what is seen now. Throws std::logic_error when called before reset(), when time does not
  /// rise, when navigation or goal are not finite, when a frame comes from the future or does not fit its camera's size
  /// or the needed channel (corners have no size), or when do_update() returns a command that is not finite or has the
  /// wrong number of signals. A speed above the limit is scaled down to it.
  Decision update(const Observation& observation);

  /// Figures of the flight so far, for result.json.
  std::vector<Metric> metrics() const { return do_metrics(); }
  /// The map so far; empty for a module that keeps none.
  Map map() const { return do_map(); }
  /// An image (CV_8UC3, RGB) of what the module saw and chose last; empty when it has none. Called for films only.
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
