#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "scenes/additions.h"
#include "scenes/textures/park_textures.h"
#include "scenes/world_config.h"
#include "sim/fields/field.h"

namespace hedgehop::scenes::worlds {

/// One tree on a meadow: the obstacle of [Andert2007] sec. 5, with a crown diameter of 10 m. The crown consists of
/// convex lumps, each a solid. Height, trunk and leaves are not given in the paper.
struct TreeConfig {
  static constexpr std::string_view kName = "tree";
  static constexpr std::string_view kMeaning = "one tree on a meadow, with a crown diameter of 10 m";

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
void describe(Visitor& v, fields::ConfigOf<TreeConfig> auto& c) {
  v("north", c.north_m,
    {.unit = "m", .at_least = -1000.0, .at_most = 1000.0, .meaning = "north position of the trunk"});
  v("east", c.east_m, {.unit = "m", .at_least = -1000.0, .at_most = 1000.0, .meaning = "east position of the trunk"});
  v("crown_diameter", c.crown_diameter_m,
    {.unit = "m", .at_least = 0.5, .at_most = 50.0, .meaning = "diameter of the crown"});
  v("height", c.height_m, {.unit = "m", .at_least = 1.0, .at_most = 100.0, .meaning = "height of the tree"});
  v("clear_height", c.clear_height_m,
    {.unit = "m", .at_least = 0.0, .meaning = "height of the trunk below the crown; less than the tree's height"});
  v("trunk_diameter", c.trunk_diameter_m,
    {.unit = "m", .above = 0.0, .meaning = "diameter of the trunk; at most that of the crown"});
  v("leaves", c.leaves, {.choices = {"broad", "needles", "autumn"}, .meaning = "kind of leaves"});
  describe_texture_size(v, c.texture_size_px);
  describe(v, c.added);
}

/// Returns the meadow with its tree. Depends on the arguments only.
/// @throws std::invalid_argument with the field, its value and the valid values.
Scene make_tree(const TreeConfig& config, uint64_t seed);

/// Trees at random positions at least `spacing` apart (Poisson-disc sampling), on a square around the origin with one
/// tree per 2 spacing^2. A crown is one convex lump with a solid of the same shape; a trunk is a cylinder.
struct ForestConfig {
  static constexpr std::string_view kName = "forest";
  static constexpr std::string_view kMeaning = "trees at random positions with a minimum spacing";

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
void describe(Visitor& v, fields::ConfigOf<ForestConfig> auto& c) {
  v("trees", c.trees, {.at_least = 1.0, .at_most = 10000.0, .meaning = "number of trees"});
  v("spacing", c.spacing_m,
    {.unit = "m",
     .at_least = 0.5,
     .at_most = 100.0,
     .meaning = "minimum distance between trunks; the area per tree is 2 spacing^2"});
  v("min_height", c.min_height_m,
    {.unit = "m", .at_least = 1.0, .at_most = 100.0, .meaning = "minimum height of a tree"});
  v("max_height", c.max_height_m,
    {.unit = "m", .at_least = 1.0, .at_most = 100.0, .meaning = "maximum height of a tree"});
  v("min_crown_diameter", c.min_crown_diameter_m,
    {.unit = "m", .at_least = 0.2, .at_most = 50.0, .meaning = "minimum diameter of a crown"});
  v("max_crown_diameter", c.max_crown_diameter_m,
    {.unit = "m", .at_least = 0.2, .at_most = 50.0, .meaning = "maximum diameter of a crown"});
  v("clear_height", c.clear_height_m,
    {.unit = "m", .at_least = 0.0, .meaning = "height of the trunks below the crowns; less than min_height"});
  v("min_trunk_diameter", c.min_trunk_diameter_m,
    {.unit = "m", .at_least = 0.001, .at_most = 50.0, .meaning = "minimum diameter of a trunk"});
  v("max_trunk_diameter", c.max_trunk_diameter_m,
    {.unit = "m",
     .at_least = 0.001,
     .at_most = 50.0,
     .meaning = "maximum diameter of a trunk; at most min_crown_diameter"});
  v("keep_clear", c.keep_clear, {.meaning = "discs of the plan free of trees and crowns, such as start and goal"});
  describe_texture_size(v, c.texture_size_px);
  describe(v, c.added);
}

/// Returns the forest of `config`. Depends on the arguments only.
/// @throws std::invalid_argument with the field, its value and the valid values, also if the trees do not fit.
Scene make_forest(const ForestConfig& config, uint64_t seed);

}  // namespace hedgehop::scenes::worlds
