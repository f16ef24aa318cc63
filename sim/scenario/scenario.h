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
#include "sim/scenario/rig.h"

namespace hedgehop::sim {

/// Where and how the flight begins: a trimmed hover.
struct StartConfig {
  double north_m = 0.0, east_m = 0.0;
  double altitude_m = 10.0;  ///< above W's origin, positive up
  double heading_rad = 0.0;  ///< from north to east
  double spread_m = 0.0;

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
    {.unit = "m", .at_least = 0.0, .required = true, .meaning = "height above the scene's origin"});
  v("heading", c.heading_rad,
    {.unit = "deg", .at_least = -360.0, .at_most = 360.0, .meaning = "direction of the nose, from north to east"});
  v("spread", c.spread_m,
    {.unit = "m", .at_least = 0.0, .meaning = "radius of the disc the start is drawn from, by the seed"});
}

/// Where the flight should end, or a place to pass on the way: an upright cylinder.
struct GoalConfig {
  double north_m = 0.0, east_m = 0.0;
  double altitude_m = 10.0;         ///< above W's origin, positive up
  double heading_rad = 0.0;         ///< from north to east
  double radius_m = 5.0;            ///< horizontal distance that counts as reached, or passed
  double height_tolerance_m = 3.0;  ///< difference of altitude that does

  Eigen::Vector3d p_WG() const { return {north_m, east_m, -altitude_m}; }
  /// Whether a position counts as reached, or passed: what flies over a place, or under it, has not been there.
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
    {.unit = "m", .at_least = 0.0, .required = true, .meaning = "height to hold above the scene's origin"});
  v("heading", c.heading_rad,
    {.unit = "deg", .at_least = -360.0, .at_most = 360.0, .meaning = "heading to hold, from north to east"});
  v("radius", c.radius_m, {.unit = "m", .above = 0.0, .meaning = "horizontal distance that counts as reached"});
  v("height_tolerance", c.height_tolerance_m,
    {.unit = "m", .above = 0.0, .meaning = "difference from the altitude that counts as reached"});
}

/// Altitudes that the mission may fly at, above W's origin, positive up: a module that can climbs and sinks within.
struct AltitudeBandConfig {
  double min_m = 0.0, max_m = 0.0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<AltitudeBandConfig> auto& c) {
  v("min", c.min_m, {.unit = "m", .at_least = 0.0, .required = true, .meaning = "lowest altitude"});
  v("max", c.max_m, {.unit = "m", .at_least = 0.0, .required = true, .meaning = "highest altitude"});
}

/// Which camera's flow measures the horizontal velocity for the navigation filter.
struct VelocimeterConfig {
  bool enabled = true;
  std::string camera = "down";
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<VelocimeterConfig> auto& c) {
  v("enabled", c.enabled, {.meaning = "whether the navigation filter gets velocities from optic flow"});
  v("camera", c.camera, {.meaning = "role of the camera, which looks down"});
}

/// Another module, or the same with other parameters, that takes over during the flight. It watches from the start: it
/// gets every observation, and is not obeyed before.
struct TakeoverConfig {
  double at_s = 0.0;
  AvoidanceConfig avoidance;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<TakeoverConfig> auto& c) {
  v("at", c.at_s,
    {.unit = "s", .at_least = 0.0, .at_most = 86400.0, .required = true, .meaning = "its first decision"});
  v("avoidance", c.avoidance,
    {.required = true, .selector = "module", .meaning = "what takes over; it needs the same cameras"});
}

/// Where a scenario comes from that `hedgehop falsify` wrote.
struct OriginConfig {
  std::string search, failed, trajectory_hash, version;
  double robustness = 0.0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<OriginConfig> auto& c) {
  v("search", c.search, {.required = true, .meaning = "file of the search that found it"});
  v("failed", c.failed, {.required = true, .meaning = "check that failed"});
  v("robustness", c.robustness, {.required = true, .meaning = "of that check, < 0"});
  v("trajectory_hash", c.trajectory_hash, {.required = true, .meaning = "of the flight that failed"});
  v("version", c.version, {.required = true, .meaning = "of Hedgehop, which found it"});
}

struct FilmConfig {
  bool enabled = true;
  double rate_hz = 10.0;
  int width_px = 960;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<FilmConfig> auto& c) {
  v("enabled", c.enabled, {.meaning = "whether a run films its cameras and the module's image"});
  v("rate", c.rate_hz,
    {.unit = "Hz", .at_least = fields::kMinRateHz, .meaning = "images a second; divides the physics rate"});
  v("width", c.width_px, {.unit = "px", .at_least = 64, .at_most = 4096, .meaning = "width of the film"});
}

/// One flight, whole: with the seed, all that decides it.
struct Scenario {
  std::string name;
  std::string description;
  uint64_t seed = 1;
  double duration_s = 60.0;
  int64_t physics_rate_hz = 500;
  int64_t control_rate_hz = 100;
  std::optional<double> command_latency_s;  ///< the period of the module's cameras when not given
  scenes::SceneConfig scene;
  dynamics::VehicleConfig vehicle;
  dynamics::AvionicsConfig avionics;
  dynamics::air::WindConfig wind;
  StartConfig start;
  std::vector<GoalConfig> route;                    ///< waypoints to pass before the goal
  std::optional<GoalConfig> goal;                   ///< without one, the flight holds the start's altitude and heading
  std::optional<AltitudeBandConfig> altitude_band;  ///< without one, a module keeps the height it is told
  RigConfig rig;
  DrawingConfig drawing;
  VelocimeterConfig velocimeter;
  AvoidanceConfig avoidance;
  std::optional<TakeoverConfig> takeover;
  std::vector<FailureConfig> failures;
  std::vector<CheckConfig> checks;
  bool may_collide = false;  ///< else `no_collision` is checked, listed or not
  FilmConfig film;
  std::optional<OriginConfig> origin;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<Scenario> auto& c) {
  v("name", c.name, {.required = true, .meaning = "name in results and reports"});
  v("description", c.description, {.meaning = "what the flight is for"});
  v("seed", c.seed, {.meaning = "seeds every random stream of the flight"});
  v("duration", c.duration_s, {.unit = "s", .above = 0.0, .at_most = 86400.0, .meaning = "longest flight time"});
  v("physics_rate", c.physics_rate_hz,
    {.unit = "Hz", .at_least = 50, .at_most = 10000, .meaning = "physics steps a second; divides 1e9"});
  v("control_rate", c.control_rate_hz,
    {.unit = "Hz", .at_least = 1, .meaning = "autopilot steps a second; divides the physics rate"});
  v("command_latency", c.command_latency_s,
    {.unit = "s",
     .at_least = 0.0,
     .at_most = 10.0,
     .meaning = "from exposure to the command's effect; else one period of the module's cameras"});
  v("scene", c.scene, {.required = true, .meaning = "what the world is"});
  v("vehicle", c.vehicle, {.required = true, .meaning = "what flies"});
  v("avionics", c.avionics, {.meaning = "onboard sensors, navigation filter and autopilot"});
  v("wind", c.wind, {.meaning = "steady wind and turbulence"});
  v("start", c.start, {.required = true, .meaning = "where the flight begins, in a trimmed hover"});
  v("route", c.route, {.meaning = "places to pass, in order, before the goal: within their radii, at their heights"});
  v("goal", c.goal, {.meaning = "where the flight should end; none for a flight that explores"});
  v("altitude_band", c.altitude_band,
    {.meaning = "heights that the module may choose to fly at; what it keeps to, the check of that name tells"});
  v("rig", c.rig, {.meaning = "the cameras on board"});
  v("drawing", c.drawing, {.meaning = "how their images are made"});
  v("velocimeter", c.velocimeter, {.meaning = "horizontal velocity from the optic flow of one camera"});
  v("avoidance", c.avoidance, {.required = true, .selector = "module", .meaning = "who decides where to fly"});
  v("takeover", c.takeover, {.meaning = "who decides from a moment on; `hedgehop branch` writes it"});
  v("failures", c.failures, {.meaning = "what fails in flight: sensors, cameras, motors or servos, the link"});
  v("checks", c.checks, {.selector = "check", .meaning = "what must hold of the flight, beside no_collision"});
  v("may_collide", c.may_collide,
    {.meaning = "whether a collision is no failure, so that no_collision is not checked"});
  v("film", c.film, {.meaning = "film of the flight"});
  v("origin", c.origin, {.meaning = "where a counterexample comes from; changes nothing of the flight"});
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

/// Reads a scenario, strictly. @param overrides  texts `a.b.0.c=value`, value in YAML, laid over the file in order.
/// Throws InputError with every fault found: unknown, missing or doubled keys, wrong types, values that are not finite
/// or out of bounds, and what does not fit together.
Scenario load_scenario(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// Reads a vehicle's file, as strictly. Throws InputError with every fault found.
dynamics::VehicleConfig load_vehicle(const std::filesystem::path& file);

/// The scenario in full, every key written, no file used: reads back to the same values, bit for bit.
std::string to_yaml(const Scenario& scenario);

/// JSON Schema (draft 2020-12) of a scenario file, for editors.
std::string json_schema();

}  // namespace hedgehop::sim
