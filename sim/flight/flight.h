#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/figures.h"
#include "scenes/scene.h"

/// What a flight leaves: the result, the two tables, the map. Frames and units as in CONTRIBUTING.md.
namespace hedgehop::sim {

struct RecordedPoint {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();           ///< m
  Eigen::Matrix3d covariance_W = Eigen::Matrix3d::Zero();  ///< m^2
  std::optional<bool> is_true;  ///< is matched with a true corner (MapScore); none where corners are unknown
};

struct RecordedCorner {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< true, m
  bool counts = false;                            ///< was in sight long enough (MapScore)
  bool found = false;                             ///< is matched with a point of the map (MapScore)
};

struct PlannedPath {
  double t_s = 0.0;                        ///< of the decision; it holds until the next one
  std::vector<Eigen::Vector2d> places_NE;  ///< to turn at, m, the last one included
};

struct MapRecord {
  std::vector<RecordedPoint> points;
  std::vector<RecordedCorner> corners;
  std::vector<Eigen::Vector2d> course_NE;  ///< m
  std::vector<PlannedPath> paths;          ///< detours, in order of time; MapLog (sim/loop) chooses them

  bool empty() const { return points.empty() && course_NE.empty(); }
};

/// How a flight ended.
enum class Outcome {
  reached,   ///< at the goal: inside its radius, and at its height (GoalConfig::holds)
  collided,  ///< contact of the hull with a solid or the ground
  timeout,   ///< the scenario's duration is over; for a scenario without a goal the normal end
  fault,     ///< the module threw or the state stopped being finite
};
std::string_view to_string(Outcome outcome);

/// One control tick: truth, estimate, command.
struct TrajectoryRow {
  double t_s = 0.0;
  Eigen::Vector3d p_WB_true, rpy_true, v_WB_W_true, w_WB_B_true;  ///< m, rad (3-2-1), m/s, rad/s
  Eigen::Vector3d p_WB_est, rpy_est, v_WB_W_est;
  std::optional<Eigen::Vector2d> v_WB_W_cmd;  ///< north, east; none while another kind of command holds
  std::optional<double> altitude_cmd_m, heading_cmd_rad;
  double obstacle_clearance_m = 0.0, ground_clearance_m = 0.0;  ///< +inf where there is nothing
  Eigen::Vector4d controls = Eigen::Vector4d::Zero();  ///< where the actuators stand, see Flight::control_names
  Eigen::Vector3d wind_W = Eigen::Vector3d::Zero();    ///< m/s
  bool model_valid = true;                             ///< false where the rotors leave the range of momentum theory
  std::optional<double> range_m;                       ///< last reading of the range finder; none when it read nothing
};

/// One decision of the module.
struct DecisionRow {
  double t_s = 0.0;
  std::string status;
  std::optional<Eigen::Vector2d> v_WB_W_cmd;
  std::optional<double> altitude_cmd_m, heading_cmd_rad;
  std::vector<double> signals;  ///< in the order of Flight::signals; NaN where unknown
};

/// Begins the name of every figure that a module reports of itself, so that none can pass for one of the judge's.
inline constexpr std::string_view kModulePrefix = "module.";

struct NamedUnit {
  std::string name, unit;
};

/// Smallest distance of the hull to something, and when; +inf when nothing was ever within reach of the search.
struct ClosestApproach {
  double distance_m = 0.0;
  double t_s = 0.0;
  std::string what;                       ///< name of the solid, "ground", or "" for none
  Eigen::Vector3d p_WB_true = {0, 0, 0};  ///< where the vehicle was
};

struct CheckResult {
  std::string name;
  bool passed = false;
  double value = 0.0;  ///< NaN when it could not be measured
  double limit = 0.0;  ///< NaN when the check has no number
  std::string unit;
  std::string_view must = "<=";  ///< how the value must stand to the limit: "<=", ">=" or ">"
  std::optional<double> t_s;     ///< when the value was taken; none where it is of the whole flight
};

/// Where a figure of a flight comes from.
enum class FigureKind {
  judged,    ///< from the true flight
  module,    ///< from the module itself
  wall_time  ///< from the machine: differs from run to run, so two flights that are equal may differ in it
};
std::string_view to_string(FigureKind kind);

struct MetricValue {
  std::string name;
  double value = 0.0;
  std::string unit;
  FigureKind kind = FigureKind::judged;
};

/// Median and 95th percentile of a stage's wall time, ms. Never part of anything that affects a flight.
struct StageTime {
  double median_ms = 0.0, p95_ms = 0.0;
};

/// What a flight's bits depend on besides the build: two flights of one build are equal where these are.
struct Libraries {
  std::string images;     ///< who computed on them: "OpenCV 4.6.0"
  std::string functions;  ///< sin, exp and the like: "SLEEF 3.5.1"
  std::string renderer;   ///< one line: "tiles", or vendor, renderer and version of OpenGL
};

struct FlightResult {
  Outcome outcome = Outcome::fault;
  std::string cause;  ///< one line for collided and fault, else empty
  /// What is true of all that the module got: "camera 'front': projected corners", "sensor 'gps': exact"; empty where
  /// all of it was measured.
  std::vector<std::string> truth_used;
  std::vector<std::string> failures;  ///< that the scenario set: "20 s to 22 s: camera.front black"
  double flight_time_s = 0.0, path_length_m = 0.0, mean_speed_mps = 0.0;
  ClosestApproach closest_obstacle, closest_ground;
  std::optional<double> goal_distance_m;  ///< at the end, horizontal; none without a goal
  int64_t decisions = 0;
  StageTime decision_ms, render_ms, velocimeter_ms,
      physics_ms;  ///< per decision, per instant (all cameras), per frame, per tick
  double realtime_factor = 0.0, wall_s = 0.0;
  std::vector<CheckResult> checks;
  std::string trajectory_hash;  ///< of the true state at every control tick, bit for bit
  Libraries libraries;
  std::vector<MetricValue> metrics;
  scenes::SceneFigures scene;  ///< of what stands at the height of the start, within a meter
};

struct Flight {
  FlightResult result;
  std::array<std::string, 4> control_names;  ///< of TrajectoryRow::controls, with units: "collective_rad"
  std::vector<NamedUnit> signals;
  std::vector<TrajectoryRow> trajectory;
  std::vector<DecisionRow> decisions;
  double command_latency_s = 0.0;              ///< from a decision to its command's effect, >= 0
  MapRecord map;                               ///< empty for a module that makes no map
  std::shared_ptr<const scenes::Scene> scene;  ///< that was flown through
};

}  // namespace hedgehop::sim
