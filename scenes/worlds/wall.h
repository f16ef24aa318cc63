#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "scenes/additions.h"
#include "scenes/world_config.h"
#include "sim/fields/field.h"

namespace hedgehop::scenes::worlds {

/// An opening in a wall; it may reach the ground or an edge of the wall.
struct WallOpening {
  double middle_m = 0.0;  ///< of its center, east of the wall's center
  double bottom_m = 0.0;  ///< above the ground
  double width_m = 3.0;
  double height_m = 3.0;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<WallOpening> auto& c) {
  v("middle", c.middle_m, {.unit = "m", .meaning = "center of the opening, east of the wall's center"});
  v("bottom", c.bottom_m, {.unit = "m", .at_least = 0.0, .meaning = "lower edge above the ground"});
  v("width", c.width_m, {.unit = "m", .above = 0.0, .meaning = "width from west to east"});
  v("height", c.height_m, {.unit = "m", .above = 0.0, .meaning = "height of the opening"});
}

/// A single wall on a meadow, from west to east, with its south face at `north`. With `vary`, the seed draws
/// that distance and the position and size of the opening, each within that share of the configured value.
struct WallConfig {
  static constexpr std::string_view kName = "wall";
  static constexpr std::string_view kMeaning = "a wall across the path, with an optional opening";

  enum class Surface { brick, clouded, blank };
  double north_m = 20.0;
  double width_m = 30.0;
  double height_m = 10.0;
  double thickness_m = 0.4;
  Surface surface = Surface::brick;
  std::optional<WallOpening> opening;
  double vary = 0.0;
  int64_t texture_size_px = 512;
  SceneAdditions added;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<WallConfig> auto& c) {
  v("north", c.north_m,
    {.unit = "m", .at_least = -1000.0, .at_most = 1000.0, .meaning = "position of the wall's south face"});
  v("width", c.width_m,
    {.unit = "m", .at_least = 1.0, .at_most = 1000.0, .meaning = "width from west to east, centered"});
  v("height", c.height_m, {.unit = "m", .at_least = 0.5, .at_most = 200.0, .meaning = "height of the wall"});
  v("thickness", c.thickness_m, {.unit = "m", .at_least = 0.05, .at_most = 10.0, .meaning = "thickness of the wall"});
  v("surface", c.surface,
    {.choices = {"brick", "clouded", "blank"}, .meaning = "bricks; smooth gradients without corners; a single color"});
  v("opening", c.opening, {.meaning = "opening in the wall"});
  v("vary", c.vary,
    {.at_least = 0.0,
     .at_most = 0.3,
     .meaning = "share by which the seed varies the wall's distance and its opening; 0: no variation"});
  describe_texture_size(v, c.texture_size_px);
  describe(v, c.added);
}

/// Returns the meadow with its wall. Depends on the arguments only.
/// @throws std::invalid_argument with the field, its value and the valid values.
Scene make_wall(const WallConfig& config, uint64_t seed);

}  // namespace hedgehop::scenes::worlds
