#pragma once

#include <cstdint>
#include <vector>

#include "scenes/mesh/mesh_builder.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes::worlds {

/// The surface of a road, which differs from place to place: parts of its own textures, and repairs.
struct Wear {
  std::vector<uint32_t> surfaces;  ///< textures of the road, equal in their markings
  uint32_t repairs = 0;            ///< texture of repairs
  double repairs_tile_m = 16.0;    ///< its side
  Random random;
};

/// Adds a panel of a road that runs down the image, as MeshBuilder::add() does. It is divided into stretches of about
/// 5 m, each with a random part of a random surface in either direction; half of the area between the insets is
/// repaired. The panel's border has no more corners than its own four, so neighbors have no cracks.
/// @param inset_m  of repairs from the left and right side; 0.4 times the width if the panel is not wider than both.
void add_worn(const mesh::TexturedPanel& panel, const mesh::ImageArea& area, double inset_m, Wear& wear,
              mesh::MeshBuilder& mesh);

}  // namespace hedgehop::scenes::worlds
