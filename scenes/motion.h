#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string_view>
#include <variant>
#include <vector>

namespace hedgehop::scenes {

/// A place that a mover passes through; altitude is above W's origin, positive up.
struct Waypoint {
  double north_m = 0.0, east_m = 0.0, altitude_m = 0.0;

  Eigen::Vector3d p_W() const { return {north_m, east_m, -altitude_m}; }
};

template <class Visitor>
void describe(Visitor& v, Waypoint& c) {
  v("north", c.north_m, {.unit = "m", .meaning = "north of the origin"});
  v("east", c.east_m, {.unit = "m", .meaning = "east of the origin"});
  v("altitude", c.altitude_m, {.unit = "m", .meaning = "of the mover's foot above the origin"});
}

/// Straight from point to point at one speed; a single point stands still.
struct WaypointMotion {
  static constexpr std::string_view kName = "waypoints";
  static constexpr std::string_view kMeaning = "straight from point to point at one speed; a single point stands still";

  enum class Repeat { once, back_and_forth, round };
  std::vector<Waypoint> points = {{}};
  double speed_mps = 1.0;
  Repeat repeat = Repeat::once;
  double start_s = 0.0;  ///< at rest on the first point until then
};

template <class Visitor>
void describe(Visitor& v, WaypointMotion& c) {
  v("points", c.points, {.meaning = "the path, in order; at least one point"});
  v("speed", c.speed_mps, {.unit = "m/s", .at_least = 0.0, .meaning = "along the path"});
  v("repeat", c.repeat,
    {.choices = {"once", "back_and_forth", "round"}, .meaning = "stop at the end, fly back, or close the path"});
  v("start", c.start_s, {.unit = "s", .at_least = 0.0, .meaning = "at rest on the first point until then"});
}

/// A level circle.
struct OrbitMotion {
  static constexpr std::string_view kName = "orbit";
  static constexpr std::string_view kMeaning = "a level circle at one speed";

  double north_m = 0.0, east_m = 0.0, altitude_m = 0.0;  ///< of the center
  double radius_m = 5.0;
  double speed_mps = 1.0;    ///< > 0: clockwise seen from above, north to east
  double bearing_rad = 0.0;  ///< of the mover seen from the center at the start, from north to east
  double start_s = 0.0;      ///< at rest until then
};

template <class Visitor>
void describe(Visitor& v, OrbitMotion& c) {
  v("north", c.north_m, {.unit = "m", .meaning = "center, north of the origin"});
  v("east", c.east_m, {.unit = "m", .meaning = "center, east of the origin"});
  v("altitude", c.altitude_m, {.unit = "m", .meaning = "of the mover's foot above the origin"});
  v("radius", c.radius_m, {.unit = "m", .above = 0.0, .meaning = "of the circle"});
  v("speed", c.speed_mps, {.unit = "m/s", .meaning = "along the circle; clockwise seen from above when positive"});
  v("bearing", c.bearing_rad, {.unit = "deg", .meaning = "seen from the center at the start, from north to east"});
  v("start", c.start_s, {.unit = "s", .at_least = 0.0, .meaning = "at rest until then"});
}

/// How a mover's frame M travels; its axes stay those of W.
using Motion = std::variant<WaypointMotion, OrbitMotion>;

/// Throws std::invalid_argument "motion.<field>: <value>; ..." unless every field keeps its bounds and there is a
/// point.
void require_motion(const Motion& motion);

/// Returns the position of M, in W, m; continuous in time.
/// @param t_s  >= 0.
Eigen::Vector3d p_WM(const Motion& motion, double t_s);

/// Returns the velocity of M, in W, m/s: the derivative of p_WM() towards later times.
Eigen::Vector3d v_WM(const Motion& motion, double t_s);

/// Returns the corners of the path, in order, in W, m; a closed path ends where it begins. An orbit has 64 corners.
std::vector<Eigen::Vector3d> path_W(const Motion& motion);

}  // namespace hedgehop::scenes
