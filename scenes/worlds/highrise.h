#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "scenes/additions.h"

namespace hedgehop::scenes::worlds {

/// The two objects of [Shah2009] fig. 4.5 and fig. 4.6 on a meadow: a cube with 8 corners, and high-rises with 35. The
/// thesis prints no sizes: ours are a cube 18 m high, and a block tower beside three towers with spires. With `vary`
/// the seed draws the towers of the skyline: each side and height within that share of its own, each place within that
/// share of 12 m, all inside the extent of the plain skyline, 4 m apart at least; the count of corners stays 35.
struct HighriseConfig {
  static constexpr std::string_view kName = "highrise";
  static constexpr std::string_view kMeaning = "a cube with 8 corners, or high-rises with 35";

  enum class Layout { cube, skyline };
  enum class Walls { plain, windows };
  Layout layout = Layout::skyline;
  Walls walls = Walls::plain;
  double scale = 1.0;
  double vary = 0.0;  ///< the cube is what it is
  int64_t texture_size_px = 512;
  SceneAdditions added;
};

template <class Visitor>
void describe(Visitor& v, HighriseConfig& c) {
  v("layout", c.layout, {.choices = {"cube", "skyline"}, .meaning = "8 corners or 35"});
  v("walls", c.walls, {.choices = {"plain", "windows"}, .meaning = "plain walls have no corners of their own"});
  v("scale", c.scale,
    {.at_least = 0.1, .at_most = 10.0, .meaning = "times 18 m for the cube, times 40 m for the towers"});
  v("vary", c.vary,
    {.at_least = 0.0,
     .at_most = 0.5,
     .meaning = "share by which the seed varies the towers of the skyline, sizes and places; 0: always the same"});
  v("texture_size", c.texture_size_px,
    {.unit = "px",
     .at_least = 64.0,
     .at_most = 2048.0,
     .meaning = "side of the images on the surfaces, a power of two"});
  describe(v, c.added);
}

/// Returns the corners of the objects: what a map of the scene should hold. In W, m; those at z = 0 stand on the
/// ground.
/// @param seed  of the scene; ineffective where nothing varies.
std::vector<Eigen::Vector3d> highrise_corners(const HighriseConfig& config, uint64_t seed);

/// Returns the scene of `config`, a function of its arguments alone.
/// @throws std::invalid_argument naming the field, its value and what is valid.
Scene make_highrise(const HighriseConfig& config, uint64_t seed);

}  // namespace hedgehop::scenes::worlds
