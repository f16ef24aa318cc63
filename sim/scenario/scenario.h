#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "dynamics/air/wind.h"
#include "dynamics/avionics.h"
#include "dynamics/vehicle.h"
#include "scenes/generators.h"
#include "sim/config/input_error.h"
#include "sim/fields/field.h"
#include "sim/scenario/avoidance_config.h"
#include "sim/scenario/checks.h"
#include "sim/scenario/drawing.h"
#include "sim/scenario/failures.h"
#include "sim/scenario/link_config.h"
#include "sim/scenario/rig.h"

namespace hedgehop::sim {

/// Start of the flight in a trimmed hover.
struct StartConfig {
  double north_m = 0.0, east_m = 0.0;
  double altitude_m = 10.0;  ///< above W's origin, positive up
  double heading_rad = 0.0;  ///< from north to east
  double spread_m = 0.0;
  double hold_s = 0.0;  ///< hover before the module's first decision

  /// The position without the spread, in W, m.
  Eigen::Vector3d p_WB() const { return {north_m, east_m, -altitude_m}; }
  /// Returns a position drawn uniformly from the horizontal disc of radius `spread_m` around p_WB(), in W, m.
  /// @param seed  seed of the stream "start"; equal seeds give equal positions.
  Eigen::Vector3d draw_p_WB(uint64_t seed) const;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<StartConfig> auto& c) {
  v("north", c.north_m, {.unit = "m", .required = true, .meaning = "position north of the scene's origin"});
  v("east", c.east_m, {.unit = "m", .required = true, .meaning = "position east of the scene's origin"});
  v("altitude", c.altitude_m,
    {.unit = "m",
     .required = true,
     .meaning = "height above the scene's origin; >= 0 if the scene has a ground plane"});
  v("heading", c.heading_rad,
    {.unit = "deg", .at_least = -360.0, .at_most = 360.0, .meaning = "direction of the nose, from north to east"});
  v("spread", c.spread_m,
    {.unit = "m", .at_least = 0.0, .meaning = "radius of the horizontal disc from which the seed draws the start"});
  v("hold", c.hold_s,
    {.unit = "s",
     .at_least = 0.0,
     .at_most = 3600.0,
     .meaning = "hover before the module's first decision; sensors and cameras already deliver"});
}

/// Goal or waypoint: a vertical cylinder.
struct GoalConfig {
  double north_m = 0.0, east_m = 0.0;
  double altitude_m = 10.0;         ///< above W's origin, positive up
  double heading_rad = 0.0;         ///< from north to east
  double radius_m = 5.0;            ///< horizontal distance within which it counts as reached
  double height_tolerance_m = 3.0;  ///< altitude difference within which it counts as reached

  Eigen::Vector3d p_WG() const { return {north_m, east_m, -altitude_m}; }
  /// Whether a position counts as reached. A flight over or under the cylinder does not.
  bool holds(const Eigen::Vector3d& p_WB) const {
    const Eigen::Vector3d p_GB_W = p_WB - p_WG();
    return p_GB_W.head<2>().norm() <= radius_m && std::abs(p_GB_W.z()) <= height_tolerance_m;
  }
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<GoalConfig> auto& c) {
  v("north", c.north_m, {.unit = "m", .required = true, .meaning = "position north of the scene's origin"});
  v("east", c.east_m, {.unit = "m", .required = true, .meaning = "position east of the scene's origin"});
  v("altitude", c.altitude_m,
    {.unit = "m",
     .required = true,
     .meaning = "altitude to hold, above the scene's origin; >= 0 if the scene has a ground plane"});
  v("heading", c.heading_rad,
    {.unit = "deg", .at_least = -360.0, .at_most = 360.0, .meaning = "heading to hold, from north to east"});
  v("radius", c.radius_m,
    {.unit = "m", .above = 0.0, .meaning = "horizontal distance within which the goal counts as reached"});
  v("height_tolerance", c.height_tolerance_m,
    {.unit = "m", .above = 0.0, .meaning = "altitude difference within which the goal counts as reached"});
}

/// Altitudes allowed to the mission, above W's origin, positive up. Modules that change altitude stay within.
struct AltitudeBandConfig {
  double min_m = 0.0, max_m = 0.0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<AltitudeBandConfig> auto& c) {
  v("min", c.min_m, {.unit = "m", .required = true, .meaning = "minimum altitude"});
  v("max", c.max_m, {.unit = "m", .required = true, .meaning = "maximum altitude"});
}

/// The camera whose optic flow measures the horizontal velocity for the navigation filter.
struct VelocimeterConfig {
  bool enabled = true;
  std::string camera = "down";
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<VelocimeterConfig> auto& c) {
  v("enabled", c.enabled, {.meaning = "whether optic flow measures velocity for the navigation filter"});
  v("camera", c.camera, {.meaning = "role of the downward camera"});
}

/// A second module, or the same module with other parameters, that takes over during the flight. It receives every
/// observation from the start; its decisions before the takeover have no effect.
struct TakeoverConfig {
  double at_s = 0.0;
  AvoidanceConfig avoidance;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<TakeoverConfig> auto& c) {
  v("at", c.at_s,
    {.unit = "s", .at_least = 0.0, .at_most = 86400.0, .required = true, .meaning = "time of its first decision"});
  v("avoidance", c.avoidance,
    {.required = true, .selector = "module", .meaning = "module that takes over; it must need the same cameras"});
}

/// Origin of a scenario that `hedgehop falsify` wrote.
struct OriginConfig {
  std::string search, failed, trajectory_hash, version;
  double robustness = 0.0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<OriginConfig> auto& c) {
  v("search", c.search, {.required = true, .meaning = "file of the search"});
  v("failed", c.failed, {.required = true, .meaning = "check that failed"});
  v("robustness", c.robustness, {.required = true, .meaning = "robustness of that check, < 0"});
  v("trajectory_hash", c.trajectory_hash, {.required = true, .meaning = "trajectory hash of the failed flight"});
  v("version", c.version, {.required = true, .meaning = "version of Hedgehop that ran the search"});
}

struct FilmConfig {
  bool enabled = true;
  double rate_hz = 10.0;
  int width_px = 960;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<FilmConfig> auto& c) {
  v("enabled", c.enabled, {.meaning = "whether a run records its cameras and the module's image"});
  v("rate", c.rate_hz,
    {.unit = "Hz", .at_least = fields::kMinRateHz, .meaning = "image rate; must divide the physics rate"});
  v("width", c.width_px, {.unit = "px", .at_least = 64, .at_most = 4096, .meaning = "width of the video"});
}

/// The part of the vehicle whose contact with an obstacle or the ground is a collision and ends the flight.
enum class CollisionOf {
  hull,
  center  ///< the origin of B, as papers count that draw a path between walls; the hull passes through obstacles
};

/// All inputs of one flight.
struct Scenario {
  std::string name;
  std::string description;
  std::vector<std::string> tags;
  std::string notes;
  uint64_t seed = 1;
  std::optional<uint64_t> world_seed;  ///< default: `seed`
  double duration_s = 60.0;
  std::optional<int64_t> physics_rate_hz;  ///< default: set_physics_rate()
  int64_t control_rate_hz = 100;
  std::optional<double> command_latency_s;  ///< default: the period of the module's cameras
  scenes::SceneConfig scene;
  dynamics::VehicleConfig vehicle;
  dynamics::AvionicsConfig avionics;
  dynamics::air::WindConfig wind;
  StartConfig start;
  std::vector<GoalConfig> route;   ///< waypoints before the goal
  std::optional<GoalConfig> goal;  ///< without a goal, the flight holds the start's altitude and heading
  std::optional<AltitudeBandConfig> altitude_band;  ///< without a band, a module holds the commanded altitude
  RigConfig rig;
  DrawingConfig drawing;
  VelocimeterConfig velocimeter;
  AvoidanceConfig avoidance;
  std::optional<TakeoverConfig> takeover;
  std::optional<LinkConfig> link;  ///< without a link, Hedgehop's own autopilot flies
  std::vector<FailureConfig> failures;
  std::vector<CheckConfig> checks;
  bool may_collide = false;  ///< if false, `no_collision` is always checked
  CollisionOf collision_of = CollisionOf::hull;
  FilmConfig film;
  std::optional<OriginConfig> origin;

  /// The seed of the scene and of the start. All other random streams have `seed`.
  uint64_t world() const { return world_seed.value_or(seed); }
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<Scenario> auto& c) {
  v("name", c.name, {.required = true, .meaning = "name in results and reports"});
  v("description", c.description, {.meaning = "purpose of the flight"});
  v("tags", c.tags, {.meaning = "labels in the index of `hedgehop runs`; do not affect the flight"});
  v("notes", c.notes, {.meaning = "remarks in the index of `hedgehop runs`; do not affect the flight"});
  v("seed", c.seed, {.meaning = "seed of every random stream of the flight"});
  v("world_seed", c.world_seed,
    {.meaning = "seed of the scene and of the drawn start instead of `seed`: the same world with other noise"});
  v("duration", c.duration_s, {.unit = "s", .above = 0.0, .at_most = 86400.0, .meaning = "maximum flight time"});
  v("physics_rate", c.physics_rate_hz,
    {.unit = "Hz",
     .at_least = 50,
     .at_most = 10000,
     .meaning =
         "physics rate; default: the smallest from 500 to 2000 Hz that the rates of control, sensors and cameras "
         "divide"});
  v("control_rate", c.control_rate_hz,
    {.unit = "Hz", .at_least = 1, .meaning = "autopilot rate; must divide the physics rate"});
  v("command_latency", c.command_latency_s,
    {.unit = "s",
     .at_least = 0.0,
     .at_most = 10.0,
     .meaning = "latency from exposure to the effect of the command; default: one period of the module's cameras"});
  v("scene", c.scene, {.required = true, .meaning = "the world"});
  v("vehicle", c.vehicle, {.required = true, .meaning = "the vehicle"});
  v("avionics", c.avionics, {.meaning = "onboard sensors, navigation filter and autopilot"});
  v("wind", c.wind, {.meaning = "steady wind and turbulence"});
  v("start", c.start, {.required = true, .meaning = "position and heading at the start, in a trimmed hover"});
  v("route", c.route,
    {.meaning = "waypoints in order before the goal, each passed within its radius and height tolerance"});
  v("goal", c.goal, {.meaning = "goal of the flight; without a goal the flight explores"});
  v("altitude_band", c.altitude_band,
    {.meaning = "altitudes allowed to the module; the check altitude_band verifies the flight"});
  v("rig", c.rig, {.meaning = "the cameras on board"});
  v("drawing", c.drawing, {.meaning = "rendering of the camera images"});
  v("velocimeter", c.velocimeter, {.meaning = "horizontal velocity from the optic flow of one camera"});
  v("avoidance", c.avoidance, {.required = true, .selector = "module", .meaning = "avoidance module"});
  v("takeover", c.takeover, {.meaning = "module that takes over during the flight; `hedgehop branch` writes it"});
  v("link", c.link, {.meaning = "autopilot outside Hedgehop that flies the vehicle"});
  v("failures", c.failures, {.meaning = "failures in flight: of sensors, cameras, motors, servos or the command link"});
  v("checks", c.checks, {.selector = "check", .meaning = "checks of the flight, in addition to no_collision"});
  v("may_collide", c.may_collide, {.meaning = "whether collisions are allowed; if true, no_collision is not checked"});
  v("collision_of", c.collision_of,
    {.choices = {"hull", "center"},
     .meaning = "part of the vehicle whose contact ends the flight as a collision; center: the center alone, while the "
                "hull passes through obstacles and its contacts are counted"});
  v("film", c.film, {.meaning = "video of the flight"});
  v("origin", c.origin, {.meaning = "origin of a counterexample; does not affect the flight"});
}

/// Returns the altitude of the stand of a linked flight, m above W's origin; nullopt if it is the start's.
inline std::optional<double> stand_altitude_m(const Scenario& scenario) {
  if (!scenario.link) return std::nullopt;
  return start_of(*scenario.link).stand_altitude_m;
}

/// Returns the result of `make`, which builds a part of a flight from its config. A std::invalid_argument becomes an
/// InputError with the path of the config: "'vehicle.rotor.radius': must be > 0 m, got -1".
template <class Make>
auto build_part(const std::string& path, Make&& make) {
  try {
    return make();
  } catch (const std::invalid_argument& error) {
    throw InputError(field_error(path, error));
  }
}

/// Reads a scenario strictly. @param overrides  texts `a.b.0.c=value`, value in YAML, applied to the file in order.
/// Throws InputError with every error found: unknown, missing or duplicate keys, wrong types, values that are not
/// finite or out of bounds, and contradictions between keys.
Scenario load_scenario(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// Reads a vehicle's file as strictly. Throws InputError with every error found.
dynamics::VehicleConfig load_vehicle(const std::filesystem::path& file);

/// Returns the scenario as YAML with every key and without used files. It reads back to bit-identical values.
std::string to_yaml(const Scenario& scenario);

/// Returns the JSON Schema (draft 2020-12) of a scenario file, for editors.
std::string json_schema();

}  // namespace hedgehop::sim
