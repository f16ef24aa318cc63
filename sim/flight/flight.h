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

/// The outputs of a flight: result, trajectory, decisions and map. Frames and units as in CONTRIBUTING.md.
namespace hedgehop::sim {

struct RecordedPoint {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();           ///< m
  Eigen::Matrix3d covariance_W = Eigen::Matrix3d::Zero();  ///< m^2
  std::optional<bool> is_true;  ///< whether a true corner matches (MapScore); nullopt if corners are unknown
};

struct RecordedCorner {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< true, m
  bool counts = false;                            ///< whether it was in view long enough (MapScore)
  bool found = false;                             ///< whether a point of the map matches (MapScore)
};

struct PlannedPath {
  double t_s = 0.0;                        ///< time of the decision; the path is valid until the next one
  std::vector<Eigen::Vector2d> places_NE;  ///< turning points and end, m
};

struct MapRecord {
  std::vector<RecordedPoint> points;
  std::vector<RecordedCorner> corners;
  std::vector<Eigen::Vector2d> course_NE;  ///< m
  std::vector<PlannedPath> paths;          ///< detours, in order of time; selected by MapLog (sim/loop)

  bool empty() const { return points.empty() && course_NE.empty(); }
};

/// The end of a flight.
enum class Outcome {
  reached,   ///< at the goal: within its radius and at its altitude (GoalConfig::holds)
  collided,  ///< contact of the hull with a solid or the ground
  timeout,   ///< the scenario's duration elapsed; the normal end of a scenario without a goal
  fault,     ///< the module threw an exception, or the state became non-finite
  link_lost  ///< the autopilot outside Hedgehop stopped, restarted or refused the state
};
std::string_view to_string(Outcome outcome);
/// Inverse of to_string().
std::optional<Outcome> parse_outcome(std::string_view text);

/// One control tick: truth, estimate, command.
struct TrajectoryRow {
  double t_s = 0.0;
  Eigen::Vector3d p_WB_true, rpy_true, v_WB_W_true, w_WB_B_true;  ///< m, rad (3-2-1), m/s, rad/s
  Eigen::Vector3d p_WB_est, rpy_est, v_WB_W_est;
  std::optional<Eigen::Vector2d> v_WB_W_cmd;  ///< north, east; nullopt while another kind of command is active
  std::optional<double> altitude_cmd_m, heading_cmd_rad;
  double obstacle_clearance_m = 0.0, ground_clearance_m = 0.0;  ///< +inf if no obstacle or ground is within range
  Eigen::Vector4d controls = Eigen::Vector4d::Zero();  ///< positions of the actuators, see Flight::control_names
  Eigen::Vector3d wind_W = Eigen::Vector3d::Zero();    ///< m/s
  bool model_valid = true;                             ///< false if a rotor leaves the range of momentum theory
  std::optional<double> range_m;                       ///< last reading of the range finder; nullopt without a reading
};

/// One decision of the module.
struct DecisionRow {
  double t_s = 0.0;
  std::string status;
  std::optional<Eigen::Vector2d> v_WB_W_cmd;
  std::optional<double> altitude_cmd_m, heading_cmd_rad;
  std::vector<double> signals;  ///< in the order of Flight::signals; NaN if unknown
};

/// Prefix of every figure that a module reports, which distinguishes it from figures measured by the simulator.
inline constexpr std::string_view kModulePrefix = "module.";

struct NamedUnit {
  std::string name, unit;
};

/// Clearances are searched up to this distance, m. Solids farther away count as absent.
inline constexpr double kMaxClearanceM = 50.0;

/// The minimum distance of the hull to an obstacle or the ground, and its time; +inf if it was never within range.
struct ClosestApproach {
  double distance_m = 0.0;
  double t_s = 0.0;
  std::string what;                       ///< name of the solid, "ground", or ""
  Eigen::Vector3d p_WB_true = {0, 0, 0};  ///< position of the vehicle
};

struct CheckResult {
  std::string name;
  bool passed = false;
  double value = 0.0;  ///< NaN if it could not be measured
  double limit = 0.0;  ///< NaN if the check has no numeric limit
  std::string unit;
  std::string_view must = "<=";  ///< required relation of value to limit: "<=", ">=" or ">"
  std::optional<double> t_s;     ///< time of the value; nullopt if it is a value of the whole flight
  std::string cause = {};        ///< of a failure, in addition to the figures, such as the obstacle; may be empty
};

/// The source of a figure of a flight.
enum class FigureKind {
  judged,    ///< measured by the simulator on the true flight
  module,    ///< reported by the module
  wall_time  ///< wall time; may differ between equal flights
};
std::string_view to_string(FigureKind kind);

struct MetricValue {
  std::string name;
  double value = 0.0;
  std::string unit;
  FigureKind kind = FigureKind::judged;
};

/// Median and 95th percentile of a stage's wall time, ms. They must not influence a flight.
struct StageTime {
  double median_ms = 0.0, p95_ms = 0.0;
};

/// The libraries on which the bits of a flight may depend, in addition to the build. Equal builds and libraries fly
/// equal flights.
struct Libraries {
  std::string images;     ///< image processing: "OpenCV 4.6.0"
  std::string functions;  ///< mathematical functions: "SLEEF 3.5.1"
  std::string others;     ///< "Eigen 3.4.0, Bullet 3.24, assimp 5.2.5, GNU 12.2.0"
  std::string renderer;   ///< one line: "tiles", or vendor, renderer and version of OpenGL
};

/// Counts of a link to an autopilot outside Hedgehop. Repeats and answers sent again depend on wall time.
struct LinkFigures {
  std::string kind;                   ///< "ardupilot_json"
  std::string peer;                   ///< address of the autopilot; empty for a replay
  int64_t frames = 0;                 ///< physics steps
  int64_t repeated = 0, old = 0;      ///< dropped packets: of the last step again, of an earlier step
  int64_t resent = 0;                 ///< answers sent again
  int64_t missed = 0;                 ///< packets that never came
  int64_t unanswered = 0;             ///< states that the autopilot did not answer
  int64_t malformed = 0;              ///< packets of another format
  int64_t strangers = 0;              ///< packets from other addresses
  std::optional<int64_t> start_tick;  ///< physics steps before the flight; nullopt if it did not start
  double waited_s = 0.0;              ///< wall time of waiting for the autopilot
};

/// Verdict on a flight.
enum class Verdict {
  passed,     ///< the flight has checks, and all hold
  failed,     ///< a check does not hold
  unchecked,  ///< the flight has no checks
  fault,      ///< the flight ended by a fault or a lost link
  not_flown   ///< there is no result
};
std::string_view to_string(Verdict verdict);

/// Whether a command over flights of this verdict may exit with status 0.
inline bool holds(Verdict verdict) { return verdict == Verdict::passed || verdict == Verdict::unchecked; }

struct FlightResult {
  Outcome outcome = Outcome::fault;
  /// One sentence: how the flight collided, had a fault or missed its goal, else its first failed check; empty if it
  /// succeeded.
  std::string cause;
  bool goal_missed_unchecked = false;  ///< a timeout before the goal, which no check requires
  /// Ground truth in the module's input: "camera 'front': projected corners", "sensor 'gps': exact"; empty if the input
  /// was entirely measured.
  std::vector<std::string> truth_used;
  std::vector<std::string> failures;  ///< injected by the scenario: "20 s to 22 s: camera.front black"
  int64_t physics_rate_hz = 0;        ///< steps of the flight dynamics per second
  double flight_time_s = 0.0, path_length_m = 0.0, mean_speed_mps = 0.0;
  ClosestApproach closest_obstacle, closest_ground;
  std::optional<double> goal_distance_m;  ///< horizontal, at the end; nullopt without a goal
  int64_t decisions = 0;
  StageTime decision_ms, render_ms, velocimeter_ms,
      physics_ms;  ///< per decision, per instant (all cameras), per frame, per tick
  double realtime_factor = 0.0, wall_s = 0.0;
  std::vector<CheckResult> checks;
  std::string trajectory_hash;  ///< of the true state at every control tick, bit for bit
  Libraries libraries;
  std::vector<MetricValue> metrics;
  scenes::SceneFigures scene;       ///< of the obstacles within one meter of the start's altitude
  std::optional<LinkFigures> link;  ///< of a linked flight
};

/// Returns the verdict on a flight that has a result; every other decision of "passed" uses this function.
Verdict verdict_of(const FlightResult& result);

/// Returns the smaller of the distances to obstacles and to the ground.
const ClosestApproach& closest_approach(const FlightResult& result);

struct Flight {
  FlightResult result;
  std::array<std::string, 4> control_names;  ///< of TrajectoryRow::controls, with units: "collective_rad"
  std::vector<NamedUnit> signals;
  std::vector<TrajectoryRow> trajectory;
  std::vector<DecisionRow> decisions;
  double command_latency_s = 0.0;              ///< from a decision to the effect of its command, >= 0
  MapRecord map;                               ///< empty if the module builds no map
  ClosestApproach last_obstacle;               ///< nearest obstacle at the end; +inf if none is within range
  std::shared_ptr<const scenes::Scene> scene;  ///< the scene of the flight
};

}  // namespace hedgehop::sim
