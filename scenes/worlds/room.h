#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "scenes/additions.h"
#include "scenes/clearing.h"
#include "scenes/scene.h"

namespace hedgehop::scenes::worlds {

/// A closed rectangular room centered on the origin of W, floor at z = 0; its free space measures exactly
/// `length` (north) x `width` (east) x `height`. Walls and ceiling are solids outside of it.
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
void describe(Visitor& v, RoomConfig& c) {
  v("length", c.length_m,
    {.unit = "m", .at_least = 1.0, .at_most = 1000.0, .meaning = "free space from the south to the north wall"});
  v("width", c.width_m,
    {.unit = "m", .at_least = 1.0, .at_most = 1000.0, .meaning = "free space from the west to the east wall"});
  v("height", c.height_m, {.unit = "m", .at_least = 1.0, .at_most = 100.0, .meaning = "height of the walls"});
  v("wall_thickness", c.wall_thickness_m,
    {.unit = "m", .at_least = 0.05, .at_most = 5.0, .meaning = "of walls and ceiling"});
  v("ceiling", c.ceiling, {.meaning = "false: the walls stand in the open, under the sky"});
  v("furniture", c.furniture,
    {.at_least = 0.0, .at_most = 1000.0, .meaning = "number of pieces, half of them against a wall"});
  v("furniture_gap", c.furniture_gap_m,
    {.unit = "m",
     .at_least = 0.0,
     .meaning = "smallest gap between two pieces, and between a wall and a piece off it"});
  v("keep_clear", c.keep_clear, {.meaning = "discs of the plan without furniture"});
  v("texture_size", c.texture_size_px,
    {.unit = "px",
     .at_least = 64.0,
     .at_most = 2048.0,
     .meaning = "side of the images on the surfaces, a power of two"});
  describe(v, c.added);
}

/// Returns the room of `config`, a function of its arguments alone.
/// @throws std::invalid_argument naming the field, its value and what is valid; also when the furniture does not fit.
Scene make_room(const RoomConfig& config, uint64_t seed);

}  // namespace hedgehop::scenes::worlds
