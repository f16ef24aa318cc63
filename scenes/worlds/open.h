#pragma once

#include <cstdint>
#include <string_view>

#include "scenes/additions.h"
#include "scenes/world_config.h"
#include "sim/fields/field.h"

namespace hedgehop::scenes::worlds {

/// Open ground without obstacles of its own.
struct OpenConfig {
  static constexpr std::string_view kName = "open";
  static constexpr std::string_view kMeaning = "a meadow without obstacles, for imported worlds and terrain";

  int64_t texture_size_px = 512;
  SceneAdditions added;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<OpenConfig> auto& c) {
  describe_texture_size(v, c.texture_size_px);
  describe(v, c.added);
}

/// Returns the meadow. @throws std::invalid_argument with the field, its value and the valid values.
Scene make_open(const OpenConfig& config, uint64_t seed);

/// Sets the bounds of an open scene to those of its solids, and at least 50 m to each side of the origin.
void set_bounds(Scene& scene);

}  // namespace hedgehop::scenes::worlds
