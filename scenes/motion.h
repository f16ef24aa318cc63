#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "scenes/pose_table.h"
#include "sim/fields/field.h"

namespace hedgehop::scenes {

/// A point on a mover's path; altitude is above W's origin, positive up.
struct Waypoint {
  double north_m = 0.0, east_m = 0.0, altitude_m = 0.0;

  Eigen::Vector3d p_W() const { return {north_m, east_m, -altitude_m}; }
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<Waypoint> auto& c) {
  v("north", c.north_m, {.unit = "m", .meaning = "north of the origin"});
  v("east", c.east_m, {.unit = "m", .meaning = "east of the origin"});
  v("altitude", c.altitude_m, {.unit = "m", .meaning = "altitude of the mover's foot above the origin"});
}

/// Straight legs between points at constant speed. With a single point, the mover is at rest.
struct WaypointMotion {
  static constexpr std::string_view kName = "waypoints";
  static constexpr std::string_view kMeaning =
      "straight legs between points at constant speed; at rest with a single point";

  enum class Repeat { once, back_and_forth, round };
  std::vector<Waypoint> points = {{}};
  double speed_mps = 1.0;
  Repeat repeat = Repeat::once;
  double start_s = 0.0;  ///< at rest at the first point until then
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<WaypointMotion> auto& c) {
  v("points", c.points, {.meaning = "points of the path, in order; at least one"});
  v("speed", c.speed_mps, {.unit = "m/s", .at_least = 0.0, .meaning = "speed along the path"});
  v("repeat", c.repeat,
    {.choices = {"once", "back_and_forth", "round"},
     .meaning = "stop at the end, return along the path, or close the path"});
  v("start", c.start_s, {.unit = "s", .at_least = 0.0, .meaning = "start time; at rest at the first point until then"});
}

/// A horizontal circle at constant speed.
struct OrbitMotion {
  static constexpr std::string_view kName = "orbit";
  static constexpr std::string_view kMeaning = "a horizontal circle at constant speed";

  double north_m = 0.0, east_m = 0.0, altitude_m = 0.0;  ///< of the center
  double radius_m = 5.0;
  double speed_mps = 1.0;    ///< > 0: clockwise seen from above, north to east
  double bearing_rad = 0.0;  ///< initial bearing of the mover from the center, from north to east
  double start_s = 0.0;      ///< at rest until then
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<OrbitMotion> auto& c) {
  v("north", c.north_m, {.unit = "m", .meaning = "center of the circle, north of the origin"});
  v("east", c.east_m, {.unit = "m", .meaning = "center of the circle, east of the origin"});
  v("altitude", c.altitude_m, {.unit = "m", .meaning = "altitude of the mover's foot above the origin"});
  v("radius", c.radius_m, {.unit = "m", .above = 0.0, .meaning = "radius of the circle"});
  v("speed", c.speed_mps, {.unit = "m/s", .meaning = "speed along the circle; if positive, clockwise seen from above"});
  v("bearing", c.bearing_rad, {.unit = "deg", .meaning = "initial bearing from the center, from north to east"});
  v("start", c.start_s, {.unit = "s", .at_least = 0.0, .meaning = "start time; at rest until then"});
}

/// The poses of a file, interpolated between its rows: positions linearly, attitudes along the shortest arc.
struct TableMotion {
  static constexpr std::string_view kName = "table";
  static constexpr std::string_view kMeaning = "position and attitude from the rows of a CSV file";

  enum class Repeat { once, back_and_forth, restart };
  std::string file;
  Repeat repeat = Repeat::once;
  double start_s = 0.0;                    ///< time of the first row
  std::shared_ptr<const PoseTable> poses;  ///< of the file, once it is loaded; not a field
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<TableMotion> auto& c) {
  v("file", c.file,
    {.required = true,
     .meaning = "CSV file: t, x, y, z, qw, qx, qy, qz in s and m; x north, y west, z up; relative to the folder of the "
                "file that names it"});
  v("repeat", c.repeat,
    {.choices = {"once", "back_and_forth", "restart"},
     .meaning = "after the last row: rest, go back through the rows, or jump to the first row"});
  v("start", c.start_s, {.unit = "s", .at_least = 0.0, .meaning = "time of the first row; at rest there until then"});
}

/// Motion of a mover's frame M. Its axes remain parallel to those of W, except those of a table.
using Motion = std::variant<WaypointMotion, OrbitMotion, TableMotion>;

/// Reads the file of a table. Other motions have none. @throws std::invalid_argument that begins with "motion.file".
void load_motion(Motion& motion);

/// Throws std::invalid_argument "motion.<field>: <value>; ..." if a field is out of bounds, the path has no points, or
/// a table is not loaded.
void require_motion(const Motion& motion);

/// Returns the position of M in W, m. It is continuous in time, except at the restart of a table. @param t_s  >= 0.
Eigen::Vector3d p_WM(const Motion& motion, double t_s);

/// Returns the pose of M in W; its rotation is exactly the identity except for tables.
Eigen::Isometry3d X_WM(const Motion& motion, double t_s);

/// Returns the velocity of M in W, m/s: the right derivative of p_WM().
Eigen::Vector3d v_WM(const Motion& motion, double t_s);

/// Returns the maximum speed of a point within `reach_m` of M's origin that moves with M, m/s.
double max_speed_mps(const Motion& motion, double reach_m, double t_s);

/// Returns the corners of the path in W, m, in order. A closed path ends at its first corner. An orbit has 64 corners;
/// a table has its rows.
std::vector<Eigen::Vector3d> path_W(const Motion& motion);

}  // namespace hedgehop::scenes
