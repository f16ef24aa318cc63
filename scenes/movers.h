#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenes/scene.h"

namespace hedgehop::scenes {

/// A moving obstacle as a scene's config lists it. M's origin is its foot.
struct MoverConfig {
  enum class Shape { balloon, pole, box, tree };

  std::string name = "mover";
  Shape shape = Shape::balloon;
  double radius_m = 0.6;
  double height_m = 6.0;
  Motion motion;
};

template <class Visitor>
void describe(Visitor& v, MoverConfig& c) {
  v("name", c.name, {.meaning = "of the obstacle in results"});
  v("shape", c.shape,
    {.choices = {"balloon", "pole", "box", "tree"},
     .meaning = "a balloon on a thin pole, an upright cylinder, a square pillar, a tree"});
  v("radius", c.radius_m, {.unit = "m", .above = 0.0, .meaning = "of balloon, pole or crown; half the width of a box"});
  v("height", c.height_m,
    {.unit = "m", .above = 0.0, .meaning = "of the top, or of the balloon's center, above the foot"});
  v("motion", c.motion, {.meaning = "how the foot travels"});
}

/// Adds movers to a scene, with the images they need, as large as those that are there.
/// @param seed  of the stream that belongs to the movers alone.
/// @throws std::invalid_argument naming the field, its value and what is valid.
void add_movers(const std::vector<MoverConfig>& movers, uint64_t seed, Scene& scene);

}  // namespace hedgehop::scenes
