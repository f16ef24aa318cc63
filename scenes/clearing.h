#pragma once

#include <Eigen/Core>

namespace hedgehop::scenes {

/// A disc of the plan that a generator leaves free, from the ground to the sky.
struct Clearing {
  double north_m = 0.0;
  double east_m = 0.0;
  double radius_m = 6.0;

  Eigen::Vector2d center_NE_m() const { return {north_m, east_m}; }
};

template <class Visitor>
void describe(Visitor& v, Clearing& c) {
  v("north", c.north_m, {.unit = "m", .meaning = "center of the disc, north of the origin"});
  v("east", c.east_m, {.unit = "m", .meaning = "center of the disc, east of the origin"});
  v("radius", c.radius_m, {.unit = "m", .at_least = 0.0, .meaning = "nothing stands nearer to the center than this"});
}

}  // namespace hedgehop::scenes
