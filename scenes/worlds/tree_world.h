#pragma once

#include <cstdint>
#include <string_view>

#include "scenes/additions.h"
#include "scenes/textures/plant_textures.h"

namespace hedgehop::scenes::worlds {

/// One tree on a meadow: the obstacle of [Andert2007] sec. 5, a crown 10 m across. The crown is made of convex lumps,
/// each a solid; height, trunk and leaves are ours.
struct TreeConfig {
  static constexpr std::string_view kName = "tree";
  static constexpr std::string_view kMeaning = "one tree on a meadow, its crown 10 m across";

  double north_m = 0.0, east_m = 0.0;
  double crown_diameter_m = 10.0;
  double height_m = 12.0;
  double clear_height_m = 2.5;
  double trunk_diameter_m = 0.7;
  textures::Leaves leaves = textures::Leaves::broad;
  int64_t texture_size_px = 512;
  SceneAdditions added;
};

template <class Visitor>
void describe(Visitor& v, TreeConfig& c) {
  v("north", c.north_m, {.unit = "m", .at_least = -1000.0, .at_most = 1000.0, .meaning = "of the trunk"});
  v("east", c.east_m, {.unit = "m", .at_least = -1000.0, .at_most = 1000.0, .meaning = "of the trunk"});
  v("crown_diameter", c.crown_diameter_m, {.unit = "m", .at_least = 0.5, .at_most = 50.0, .meaning = "of the crown"});
  v("height", c.height_m, {.unit = "m", .at_least = 1.0, .at_most = 100.0, .meaning = "of the whole tree"});
  v("clear_height", c.clear_height_m,
    {.unit = "m", .at_least = 0.0, .meaning = "of the trunk below the crown; less than the height"});
  v("trunk_diameter", c.trunk_diameter_m, {.unit = "m", .above = 0.0, .meaning = "of the trunk; at most the crown's"});
  v("leaves", c.leaves, {.choices = {"broad", "needles", "autumn"}, .meaning = "how the crown looks"});
  v("texture_size", c.texture_size_px,
    {.unit = "px",
     .at_least = 64.0,
     .at_most = 2048.0,
     .meaning = "side of the images on the surfaces, a power of two"});
  describe(v, c.added);
}

/// Returns the meadow with its tree, a function of its arguments alone.
/// @throws std::invalid_argument naming the field, its value and what is valid.
Scene make_tree(const TreeConfig& config, uint64_t seed);

}  // namespace hedgehop::scenes::worlds
