#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenes/scene.h"

namespace hedgehop::scenes {

/// A box that stands on the ground, as a scene's config lists it.
struct BoxConfig {
  std::string name = "box";
  double north_m = 0.0, east_m = 0.0;  ///< of its middle
  double length_m = 10.0;              ///< along its heading
  double width_m = 5.0;                ///< across
  double height_m = 20.0;
  double heading_rad = 0.0;  ///< of its length, from north to east

  /// Its corners in the plan (north, east), m, in order round it.
  std::vector<Eigen::Vector2d> corners_NE_m() const;
};

template <class Visitor>
void describe(Visitor& v, BoxConfig& c) {
  v("name", c.name, {.meaning = "of the obstacle in results"});
  v("north", c.north_m, {.unit = "m", .required = true, .meaning = "of its middle, north of the scene's origin"});
  v("east", c.east_m, {.unit = "m", .required = true, .meaning = "of its middle, east of the scene's origin"});
  v("length", c.length_m, {.unit = "m", .above = 0.0, .meaning = "along its heading"});
  v("width", c.width_m, {.unit = "m", .above = 0.0, .meaning = "across its heading"});
  v("height", c.height_m, {.unit = "m", .above = 0.0, .meaning = "of its top above the ground"});
  v("heading", c.heading_rad,
    {.unit = "deg", .at_least = -360.0, .at_most = 360.0, .meaning = "of its length, from north to east"});
}

/// Adds boxes of brick to a scene, with the image they need, as large as those that are there.
/// @param seed  of the stream that belongs to the boxes alone.
/// @throws std::invalid_argument naming the field, its value and what is valid.
void add_boxes(const std::vector<BoxConfig>& boxes, uint64_t seed, Scene& scene);

}  // namespace hedgehop::scenes
