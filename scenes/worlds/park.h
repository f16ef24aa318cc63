#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "scenes/additions.h"
#include "scenes/clearing.h"

namespace hedgehop::scenes::worlds {

/// A meadow with a road from south to north through its middle: vehicles parked along the road, trees, bushes and rocks
/// at random places beside it, no two nearer than `gap`.
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
  int64_t texture_size_px = 512;
  SceneAdditions added;
};

template <class Visitor>
void describe(Visitor& v, ParkConfig& c) {
  v("extent", c.extent_m,
    {.unit = "m", .at_least = 30.0, .at_most = 1000.0, .meaning = "side of the square, centered"});
  v("trees", c.trees, {.at_least = 0.0, .at_most = 1000.0, .meaning = "5 to 9 m high, crowns 3 to 6 m across"});
  v("bushes", c.bushes, {.at_least = 0.0, .at_most = 1000.0, .meaning = "1 to 2.4 m across"});
  v("rocks", c.rocks, {.at_least = 0.0, .at_most = 1000.0, .meaning = "0.8 to 2 m across"});
  v("vehicles", c.vehicles, {.at_least = 0.0, .at_most = 200.0, .meaning = "cars and vans along the road"});
  v("gap", c.gap_m, {.unit = "m", .at_least = 0.0, .meaning = "least gap in the plan between two of them"});
  v("keep_clear", c.keep_clear, {.meaning = "discs of the plan that stay free: start, goal"});
  v("texture_size", c.texture_size_px,
    {.unit = "px",
     .at_least = 64.0,
     .at_most = 2048.0,
     .meaning = "side of the images on the surfaces, a power of two"});
  describe(v, c.added);
}

/// Returns the park of `config`, a function of its arguments alone.
/// @throws std::invalid_argument naming the field, its value and what is valid; also when something does not fit.
Scene make_park(const ParkConfig& config, uint64_t seed);

}  // namespace hedgehop::scenes::worlds
