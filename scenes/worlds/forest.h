#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "scenes/additions.h"
#include "scenes/clearing.h"

namespace hedgehop::scenes::worlds {

/// Trees at random places, no two nearer than `spacing` (Poisson-disc), on a square round the origin with one tree to
/// every 2 spacing^2 of it. A crown is one convex lump, a solid as it is drawn; a trunk is a cylinder.
struct ForestConfig {
  static constexpr std::string_view kName = "forest";
  static constexpr std::string_view kMeaning = "trees at random places, no two nearer than a spacing";

  int64_t trees = 1000;
  double spacing_m = 4.0;
  double min_height_m = 8.0, max_height_m = 14.0;
  double min_crown_diameter_m = 2.4, max_crown_diameter_m = 4.4;
  double clear_height_m = 2.5;
  double min_trunk_diameter_m = 0.25, max_trunk_diameter_m = 0.5;
  std::vector<Clearing> keep_clear;
  int64_t texture_size_px = 512;
  SceneAdditions added;

  double extent_m() const;  ///< side of the square
};

template <class Visitor>
void describe(Visitor& v, ForestConfig& c) {
  v("trees", c.trees, {.at_least = 1.0, .at_most = 10000.0, .meaning = "number of trees"});
  v("spacing", c.spacing_m,
    {.unit = "m",
     .at_least = 0.5,
     .at_most = 100.0,
     .meaning = "least distance of two trunks; a tree has 2 spacing^2"});
  v("min_height", c.min_height_m, {.unit = "m", .at_least = 1.0, .at_most = 100.0, .meaning = "of the lowest tree"});
  v("max_height", c.max_height_m, {.unit = "m", .at_least = 1.0, .at_most = 100.0, .meaning = "of the highest tree"});
  v("min_crown_diameter", c.min_crown_diameter_m,
    {.unit = "m", .at_least = 0.2, .at_most = 50.0, .meaning = "of the narrowest crown"});
  v("max_crown_diameter", c.max_crown_diameter_m,
    {.unit = "m", .at_least = 0.2, .at_most = 50.0, .meaning = "of the widest crown"});
  v("clear_height", c.clear_height_m,
    {.unit = "m", .at_least = 0.0, .meaning = "of the trunks below the crowns; less than min_height"});
  v("min_trunk_diameter", c.min_trunk_diameter_m,
    {.unit = "m", .at_least = 0.001, .at_most = 50.0, .meaning = "of the thinnest trunk"});
  v("max_trunk_diameter", c.max_trunk_diameter_m,
    {.unit = "m", .at_least = 0.001, .at_most = 50.0, .meaning = "of the thickest trunk; at most min_crown_diameter"});
  v("keep_clear", c.keep_clear, {.meaning = "discs of the plan without trees, crowns included: start, goal"});
  v("texture_size", c.texture_size_px,
    {.unit = "px",
     .at_least = 64.0,
     .at_most = 2048.0,
     .meaning = "side of the images on the surfaces, a power of two"});
  describe(v, c.added);
}

/// Returns the forest of `config`, a function of its arguments alone.
/// @throws std::invalid_argument naming the field, its value and what is valid; also when the trees do not fit.
Scene make_forest(const ForestConfig& config, uint64_t seed);

}  // namespace hedgehop::scenes::worlds
