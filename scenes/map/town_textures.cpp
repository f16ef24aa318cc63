#include "scenes/map/town_textures.h"

#include "scenes/textures/park_textures.h"
#include "scenes/textures/stone_textures.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes::map {

TownTextures town_textures(int size_px, uint64_t seed) {
  TownTextures town;
  town.city = textures::city_textures(size_px, derived_seed(seed, 0), false);
  TextureList& list = town.images();
  town.roof_tiles = list.add([=] { return textures::paint_brick_wall(size_px, derived_seed(seed, 1)); });
  town.asphalt = list.add([=] { return textures::paint_asphalt_road(size_px, derived_seed(seed, 2)); });
  town.bark = list.add([=] { return textures::paint_bark(size_px, derived_seed(seed, 3)); });
  for (uint64_t k = 0; k < town.leaves.size(); ++k) {
    town.leaves[k] =
        list.add([=] { return textures::paint_leaves(textures::Leaves::broad, size_px, derived_seed(seed, 4 + k)); });
  }
  const textures::Color paints[TownTextures::kPaints] = {
      {0.62f, 0.08f, 0.08f}, {0.16f, 0.26f, 0.48f}, {0.80f, 0.80f, 0.78f}};
  town.first_paint = static_cast<uint32_t>(list.size());
  for (uint64_t k = 0; k < TownTextures::kPaints; ++k) {
    const textures::Color paint = paints[k];
    list.add([=] { return textures::paint_vehicle_body(paint, size_px, derived_seed(seed, 10 + k)); });
    list.add([=] { return textures::paint_vehicle_cabin(paint, size_px, derived_seed(seed, 20 + k)); });
  }
  return town;
}

}  // namespace hedgehop::scenes::map
