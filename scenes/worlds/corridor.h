#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "scenes/additions.h"
#include "scenes/world_config.h"
#include "sim/fields/field.h"

namespace hedgehop::scenes::worlds {

/// A section of a corridor: a bend at its start, then straight.
struct CorridorSection {
  double length_m = 10.0;
  double bend_rad = 0.0;    ///< to the right
  double width_m = 0.0;     ///< at its end, linear along the section; 0: no change
  double doorway_m = 0.0;   ///< width of a doorway at half length; 0: none
  double obstacle_m = 0.0;  ///< protrusion of a pillar at half length, from the right (> 0) or left (< 0) wall
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<CorridorSection> auto& c) {
  v("length", c.length_m, {.unit = "m", .at_least = 1.0, .at_most = 1000.0, .meaning = "length along the centerline"});
  v("bend", c.bend_rad,
    {.unit = "deg", .at_least = -60.0, .at_most = 60.0, .meaning = "bend to the right at the start of the section"});
  v("width", c.width_m,
    {.unit = "m",
     .at_least = 0.0,
     .at_most = 100.0,
     .meaning = "width at the end of the section, at least 0.5; 0: equal to the width at its start"});
  v("doorway", c.doorway_m,
    {.unit = "m",
     .at_least = 0.0,
     .at_most = 100.0,
     .meaning = "width of a doorway at half length, at least 0.3; 0: none"});
  v("obstacle", c.obstacle_m,
    {.unit = "m",
     .at_least = -100.0,
     .at_most = 100.0,
     .meaning = "protrusion of a pillar from the wall at half length; right > 0, left < 0; 0: none"});
}

/// A corridor that starts at W's origin and heads north, closed by walls at both ends. Each section continues the
/// previous one. Walls, doorways and pillars extend from floor to ceiling, except the lintels of the doors.
///
/// With `vary`, the seed draws the lengths, bends, doorways, pillars and changes of width, each within that share of
/// the configured value. The initial width is fixed. All sections except the last are then rotated and scaled together,
/// so that the last section keeps its start and its heading; its length grows by up to the share. A goal in the last
/// section therefore remains on the centerline. Bends of 0 remain 0, except that of the last section.
struct CorridorConfig {
  static constexpr std::string_view kName = "corridor";
  static constexpr std::string_view kMeaning = "a corridor of straight sections, with bends, doorways and pillars";

  double width_m = 2.5;  ///< at the start
  double height_m = 3.0;
  double door_height_m = 2.1;
  bool ceiling = true;
  std::vector<CorridorSection> sections = {{30.0}};
  double vary = 0.0;
  double texture = 1.0, floor_texture = 1.0;
  int64_t texture_size_px = 512;
  SceneAdditions added;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<CorridorConfig> auto& c) {
  v("width", c.width_m,
    {.unit = "m", .at_least = 0.5, .at_most = 100.0, .meaning = "width at the start of the corridor"});
  v("height", c.height_m, {.unit = "m", .at_least = 1.0, .at_most = 100.0, .meaning = "height from floor to ceiling"});
  v("door_height", c.door_height_m,
    {.unit = "m", .at_least = 0.5, .at_most = 100.0, .meaning = "height of doorways, at most that of the corridor"});
  v("ceiling", c.ceiling, {.meaning = "false: open to the sky"});
  v("sections", c.sections, {.meaning = "sections in order, from the origin"});
  v("vary", c.vary,
    {.at_least = 0.0,
     .at_most = 0.3,
     .meaning =
         "share by which the seed varies lengths, bends, changes of width, doorways and pillars; 0: no variation"});
  v("texture", c.texture, {.at_least = 0.0, .at_most = 1.0, .meaning = "contrast of the walls: 1 strong, 0 blank"});
  v("floor_texture", c.floor_texture,
    {.at_least = 0.0, .at_most = 1.0, .meaning = "contrast of floor and ceiling: 1 strong, 0 blank"});
  describe_texture_size(v, c.texture_size_px);
  describe(v, c.added);
}

/// Centers and edges of the free floor at both ends and between sections, in the plan (north, east), m.
struct CorridorPlan {
  std::vector<Eigen::Vector2d> middles_NE, lefts_NE, rights_NE;
};

/// Returns `along_NE` rotated by 90 degrees to the right.
inline Eigen::Vector2d to_the_right(const Eigen::Vector2d& along_NE) { return {-along_NE.y(), along_NE.x()}; }

/// Returns the variation of `config` for a seed. The `vary` of the result is 0, so that it is final.
/// @throws std::invalid_argument with the field, its value and the values that are valid for every seed.
CorridorConfig draw_corridor(const CorridorConfig& config, uint64_t seed);

/// Returns the plan of the corridor that make_corridor() builds. Throws like draw_corridor().
CorridorPlan plan_corridor(const CorridorConfig& config, uint64_t seed);

/// Returns the corridor of `config`. Depends on the arguments only. Throws like draw_corridor().
Scene make_corridor(const CorridorConfig& config, uint64_t seed);

}  // namespace hedgehop::scenes::worlds
