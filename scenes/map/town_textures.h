#pragma once

#include <array>
#include <cstdint>

#include "scenes/textures/city_textures.h"

namespace hedgehop::scenes::map {

/// The textures of a map, and their indices in the list.
struct TownTextures {
  static constexpr int kPaints = 3;

  textures::CityTextures city;
  uint32_t roof_tiles = 0;  ///< of roofs that are not flat, with sides of textures::kWallTileM
  uint32_t asphalt = 0;     ///< of paths and service roads
  uint32_t bark = 0;
  std::array<uint32_t, 2> leaves{};
  uint32_t first_paint = 0;  ///< of cars: body and cabin, kPaints times

  TextureList& images() { return city.images; }
};

/// Returns the textures of a map.
TownTextures town_textures(int size_px, uint64_t seed);

}  // namespace hedgehop::scenes::map
