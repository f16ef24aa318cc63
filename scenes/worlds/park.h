#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "scenes/additions.h"
#include "scenes/world_config.h"
#include "sim/fields/field.h"

namespace hedgehop::scenes::worlds {

/// A meadow with a road from south to north through its center: vehicles parked along the road, and trees, bushes and
/// rocks at random positions next to it, at least `gap` apart.
struct ParkConfig {
  static constexpr std::string_view kName = "park";
  static constexpr std::string_view kMeaning = "trees, bushes, rocks and parked vehicles on both sides of a road";

  double extent_m = 80.0;  ///< side of the square, centered on the origin
  int64_t trees = 14;
  int64_t bushes = 24;
  int64_t rocks = 10;
  int64_t vehicles = 6;
  double gap_m = 2.5;
  std::vector<Clearing> keep_clear = {{0.0, 0.0, 4.0}};
  bool wear = true;
  int64_t texture_size_px = 512;
  SceneAdditions added;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<ParkConfig> auto& c) {
  v("extent", c.extent_m,
    {.unit = "m", .at_least = 30.0, .at_most = 1000.0, .meaning = "side of the square, centered on the origin"});
  v("trees", c.trees,
    {.at_least = 0.0, .at_most = 1000.0, .meaning = "number of trees, 5 to 9 m high with crowns of 3 to 6 m diameter"});
  v("bushes", c.bushes, {.at_least = 0.0, .at_most = 1000.0, .meaning = "number of bushes, 1 to 2.4 m in diameter"});
  v("rocks", c.rocks, {.at_least = 0.0, .at_most = 1000.0, .meaning = "number of rocks, 0.8 to 2 m in diameter"});
  v("vehicles", c.vehicles, {.at_least = 0.0, .at_most = 200.0, .meaning = "number of cars and vans along the road"});
  v("gap", c.gap_m, {.unit = "m", .at_least = 0.0, .meaning = "minimum gap between objects in the plan"});
  v("keep_clear", c.keep_clear, {.meaning = "discs of the plan free of objects, such as start and goal"});
  v("wear", c.wear,
    {.meaning = "whether repairs of the road differ from place to place; without, its surface repeats"});
  describe_texture_size(v, c.texture_size_px);
  describe(v, c.added);
}

/// Returns the park of `config`. Depends on the arguments only.
/// @throws std::invalid_argument with the field, its value and the valid values, also if the objects do not fit.
Scene make_park(const ParkConfig& config, uint64_t seed);

}  // namespace hedgehop::scenes::worlds
