#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "scenes/additions.h"
#include "scenes/scene.h"
#include "scenes/world_config.h"
#include "sim/fields/field.h"

namespace hedgehop::scenes::worlds {

/// A closed rectangular room centered on the origin of W, with its floor at z = 0. Its free space is exactly `length`
/// (north) x `width` (east) x `height`. Walls and ceiling are solids outside of that space.
/// The default plan is the arena of [Garratt2009] sec. 4, fig. 3.
struct RoomConfig {
  static constexpr std::string_view kName = "room";
  static constexpr std::string_view kMeaning = "a closed rectangular room, with optional furniture";

  double length_m = 16.0;
  double width_m = 8.0;
  double height_m = 3.0;
  double wall_thickness_m = 0.25;
  bool ceiling = true;
  int64_t furniture = 0;
  double furniture_gap_m = 2.4;
  std::vector<Clearing> keep_clear = {{0.0, 0.0, 2.0}};
  int64_t texture_size_px = 512;
  SceneAdditions added;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<RoomConfig> auto& c) {
  v("length", c.length_m,
    {.unit = "m", .at_least = 1.0, .at_most = 1000.0, .meaning = "free length between the south and north walls"});
  v("width", c.width_m,
    {.unit = "m", .at_least = 1.0, .at_most = 1000.0, .meaning = "free width between the west and east walls"});
  v("height", c.height_m, {.unit = "m", .at_least = 1.0, .at_most = 100.0, .meaning = "height of the walls"});
  v("wall_thickness", c.wall_thickness_m,
    {.unit = "m", .at_least = 0.05, .at_most = 5.0, .meaning = "thickness of walls and ceiling"});
  v("ceiling", c.ceiling, {.meaning = "false: open to the sky"});
  v("furniture", c.furniture,
    {.at_least = 0.0, .at_most = 1000.0, .meaning = "number of pieces, half of them against a wall"});
  v("furniture_gap", c.furniture_gap_m,
    {.unit = "m",
     .at_least = 0.0,
     .meaning = "minimum gap between pieces, and between a wall and a piece that does not touch it"});
  v("keep_clear", c.keep_clear, {.meaning = "discs of the plan free of furniture"});
  describe_texture_size(v, c.texture_size_px);
  describe(v, c.added);
}

/// Returns the room of `config`. Depends on the arguments only.
/// @throws std::invalid_argument with the field, its value and the valid values, also if the furniture does not fit.
Scene make_room(const RoomConfig& config, uint64_t seed);

}  // namespace hedgehop::scenes::worlds
