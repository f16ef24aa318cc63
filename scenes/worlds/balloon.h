#pragma once

#include <cstdint>
#include <string_view>

#include "scenes/additions.h"
#include "scenes/world_config.h"
#include "sim/fields/field.h"

namespace hedgehop::scenes::worlds {

/// A meadow with a line of posts and a balloon on a pole. The pole is carried along the posts toward the origin, then
/// sideways.
struct BalloonConfig {
  static constexpr std::string_view kName = "balloon";
  static constexpr std::string_view kMeaning = "a balloon on a pole that moves along a line, on a meadow";

  double radius_m = 0.5;
  double height_m = 6.1;  ///< 20 ft
  Motion motion = WaypointMotion{.points = {{15.25, -1.5, 0.0}, {3.05, -1.5, 0.0}, {3.05, 1.5, 0.0}},
                                 .speed_mps = 0.7,
                                 .repeat = WaypointMotion::Repeat::once,
                                 .start_s = 5.0};
  int64_t markers = 5;
  double marker_spacing_m = 3.05;  ///< 10 ft
  int64_t texture_size_px = 512;
  SceneAdditions added;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<BalloonConfig> auto& c) {
  v("radius", c.radius_m, {.unit = "m", .above = 0.0, .at_most = 10.0, .meaning = "radius of the balloon"});
  v("height", c.height_m, {.unit = "m", .above = 0.0, .at_most = 100.0, .meaning = "height of the balloon's center"});
  v("motion", c.motion, {.meaning = "motion of the pole's foot"});
  v("markers", c.markers,
    {.at_least = 0.0, .at_most = 100.0, .meaning = "number of posts in a row north of the origin"});
  v("marker_spacing", c.marker_spacing_m, {.unit = "m", .above = 0.0, .meaning = "distance between posts"});
  describe_texture_size(v, c.texture_size_px);
  describe(v, c.added);
}

/// Returns the meadow with its balloon. Depends on the arguments only.
/// @throws std::invalid_argument with the field, its value and the valid values.
Scene make_balloon(const BalloonConfig& config, uint64_t seed);

}  // namespace hedgehop::scenes::worlds
