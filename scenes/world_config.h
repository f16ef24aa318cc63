#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string_view>

#include "sim/fields/field.h"

namespace hedgehop::scenes {

/// A disc of the plan that a generator leaves free, from the ground to the sky.
struct Clearing {
  double north_m = 0.0;
  double east_m = 0.0;
  double radius_m = 6.0;

  Eigen::Vector2d center_NE_m() const { return {north_m, east_m}; }
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<Clearing> auto& c) {
  v("north", c.north_m, {.unit = "m", .meaning = "center of the disc, north of the origin"});
  v("east", c.east_m, {.unit = "m", .meaning = "center of the disc, east of the origin"});
  v("radius", c.radius_m, {.unit = "m", .at_least = 0.0, .meaning = "minimum distance of obstacles from the center"});
}

/// Lists the field `texture_size` of a world's config; require_texture_size() checks the rest.
template <class Visitor, class Size>
void describe_texture_size(Visitor& v, Size& size_px) {
  v("texture_size", size_px,
    {.unit = "px",
     .at_least = 64.0,
     .at_most = 2048.0,
     .meaning = "side of the images on the surfaces, a power of two"});
}

/// Throws std::invalid_argument "<field>: <value>; valid: <valid>" unless `holds`. For relations between fields;
/// fields::require_bounds() checks the bounds of each field.
void require(bool holds, std::string_view field, double value, std::string_view valid);

/// Throws std::invalid_argument unless the size is a power of two.
void require_texture_size(int64_t size_px);

}  // namespace hedgehop::scenes
