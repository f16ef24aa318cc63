#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "scenes/additions.h"

namespace hedgehop::scenes::worlds {

/// A stretch of a corridor: a bend where it begins, then straight on.
struct CorridorSection {
  double length_m = 10.0;
  double bend_rad = 0.0;    ///< to the right
  double width_m = 0.0;     ///< where it ends, linear from where it begins; 0: no change
  double doorway_m = 0.0;   ///< width of a doorway half way; 0: none
  double obstacle_m = 0.0;  ///< how far a pillar stands out of the right (> 0) or left (< 0) wall, half way
};

template <class Visitor>
void describe(Visitor& v, CorridorSection& c) {
  v("length", c.length_m, {.unit = "m", .at_least = 1.0, .at_most = 1000.0, .meaning = "along the middle"});
  v("bend", c.bend_rad,
    {.unit = "deg", .at_least = -60.0, .at_most = 60.0, .meaning = "where the section begins, to the right"});
  v("width", c.width_m,
    {.unit = "m",
     .at_least = 0.0,
     .at_most = 100.0,
     .meaning = "where the section ends, at least 0.5; 0: as where it begins"});
  v("doorway", c.doorway_m,
    {.unit = "m", .at_least = 0.0, .at_most = 100.0, .meaning = "width of a doorway half way, at least 0.3; 0: none"});
  v("obstacle", c.obstacle_m,
    {.unit = "m",
     .at_least = -100.0,
     .at_most = 100.0,
     .meaning = "how far a pillar stands out of the wall half way; right > 0, left < 0; 0: none"});
}

/// A corridor that begins at W's origin, closed by a wall, and heads north; each section carries on from the one
/// before. Walls, doorways and pillars reach from floor to ceiling, but for the doors' lintels.
///
/// With `vary` the seed draws lengths, bends, doorways, pillars, and how much the corridor narrows or widens, each
/// within that share of its own; the corridor's first width stays. All sections but the last are then turned and scaled
/// as one, so that the last begins where it is written and heads as written, and is longer by up to the share: a goal
/// in it stays in the middle of the corridor. Bends of 0 stay 0, but for the last section's.
struct CorridorConfig {
  static constexpr std::string_view kName = "corridor";
  static constexpr std::string_view kMeaning = "a corridor of straight sections, with bends, doorways and pillars";

  double width_m = 2.5;  ///< where it begins
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
void describe(Visitor& v, CorridorConfig& c) {
  v("width", c.width_m, {.unit = "m", .at_least = 0.5, .at_most = 100.0, .meaning = "where the corridor begins"});
  v("height", c.height_m, {.unit = "m", .at_least = 1.0, .at_most = 100.0, .meaning = "from floor to ceiling"});
  v("door_height", c.door_height_m,
    {.unit = "m", .at_least = 0.5, .at_most = 100.0, .meaning = "of doorways, at most the height"});
  v("ceiling", c.ceiling, {.meaning = "false: open to the sky"});
  v("sections", c.sections, {.meaning = "from the origin on"});
  v("vary", c.vary,
    {.at_least = 0.0,
     .at_most = 0.3,
     .meaning = "share by which the seed varies lengths, bends, narrowings, doorways and pillars; 0: as written"});
  v("texture", c.texture, {.at_least = 0.0, .at_most = 1.0, .meaning = "contrast of the walls: 1 strong, 0 blank"});
  v("floor_texture", c.floor_texture,
    {.at_least = 0.0, .at_most = 1.0, .meaning = "contrast of floor and ceiling: 1 strong, 0 blank"});
  v("texture_size", c.texture_size_px,
    {.unit = "px",
     .at_least = 64.0,
     .at_most = 2048.0,
     .meaning = "side of the images on the surfaces, a power of two"});
  describe(v, c.added);
}

/// The edges of the free floor where sections meet, and at both ends, in the plan (north, east), m.
struct CorridorPlan {
  std::vector<Eigen::Vector2d> middles_NE, lefts_NE, rights_NE;
};

/// Returns `along_NE` turned a quarter to the right.
inline Eigen::Vector2d to_the_right(const Eigen::Vector2d& along_NE) { return {-along_NE.y(), along_NE.x()}; }

/// Returns the corridor that the seed makes of `config`; its `vary` is 0, so that it stays as it is.
/// @throws std::invalid_argument naming the field, its value and what is valid for every seed.
CorridorConfig draw_corridor(const CorridorConfig& config, uint64_t seed);

/// Returns the plan of the corridor that make_corridor() builds. Throws as draw_corridor() does.
CorridorPlan plan_corridor(const CorridorConfig& config, uint64_t seed);

/// Returns the corridor of `config`, a function of its arguments alone. Throws as draw_corridor() does.
Scene make_corridor(const CorridorConfig& config, uint64_t seed);

}  // namespace hedgehop::scenes::worlds
