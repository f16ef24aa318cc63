#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "scenes/additions.h"
#include "scenes/world_config.h"
#include "sim/fields/field.h"

namespace hedgehop::scenes::worlds {

/// The two objects of [Shah2009] fig. 4.5 and fig. 4.6 on a meadow: a cube with 8 corners, and high-rises with 35. The
/// thesis gives no sizes; here the cube is 18 m high, and the skyline consists of a block and three towers with spires.
/// With `vary`, the seed draws the towers of the skyline: each side and height within that share of its plain value,
/// each position within that share of 12 m. The towers remain inside the extent of the plain skyline and at least 4 m
/// apart; the number of corners remains 35.
struct HighriseConfig {
  static constexpr std::string_view kName = "highrise";
  static constexpr std::string_view kMeaning = "a cube with 8 corners, or high-rises with 35";

  enum class Layout { cube, skyline };
  enum class Walls { plain, windows };
  Layout layout = Layout::skyline;
  Walls walls = Walls::plain;
  double scale = 1.0;
  double vary = 0.0;  ///< of the skyline only
  int64_t texture_size_px = 512;
  SceneAdditions added;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<HighriseConfig> auto& c) {
  v("layout", c.layout, {.choices = {"cube", "skyline"}, .meaning = "object: 8 corners or 35"});
  v("walls", c.walls,
    {.choices = {"plain", "windows"}, .meaning = "surface of the walls; plain walls have no corners"});
  v("scale", c.scale,
    {.at_least = 0.1, .at_most = 10.0, .meaning = "size relative to 18 m for the cube and 40 m for the towers"});
  v("vary", c.vary,
    {.at_least = 0.0,
     .at_most = 0.5,
     .meaning = "share by which the seed varies sizes and positions of the towers; 0: no variation"});
  describe_texture_size(v, c.texture_size_px);
  describe(v, c.added);
}

/// Returns the corners of the objects in W, m, which a map of the scene should contain, including those on the ground.
/// @param seed  of the scene; has no effect without variation.
std::vector<Eigen::Vector3d> highrise_corners(const HighriseConfig& config, uint64_t seed);

/// Returns the scene of `config`. Depends on the arguments only.
/// @throws std::invalid_argument with the field, its value and the valid values.
Scene make_highrise(const HighriseConfig& config, uint64_t seed);

}  // namespace hedgehop::scenes::worlds
