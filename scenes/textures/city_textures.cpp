#include "scenes/textures/city_textures.h"

#include <utility>

#include "scenes/textures/facade_textures.h"
#include "scenes/textures/street_textures.h"
#include "scenes/textures/trim_textures.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes::textures {

CityTextures paint_city(int size_px, uint64_t seed) {
  CityTextures city;
  const auto add = [&](cv::Mat image) {
    city.images.push_back(std::move(image));
    return static_cast<uint32_t>(city.images.size() - 1);
  };

  city.streets = {add(paint_street(size_px, derived_seed(seed, 0))), add(paint_street(size_px, derived_seed(seed, 1)))};
  city.crossing = add(paint_crossing(size_px, derived_seed(seed, 2)));
  city.lots = {add(paint_paved_lot(size_px, derived_seed(seed, 3))),
               add(paint_parking_lot(size_px, derived_seed(seed, 4))),
               add(paint_garden_lot(size_px, derived_seed(seed, 5)))};
  city.grass = add(paint_grass(size_px, derived_seed(seed, 6)));
  city.field = add(paint_field(size_px, derived_seed(seed, 10)));
  city.roofs = {add(paint_roof(RoofCover::felt, size_px, derived_seed(seed, 7))),
                add(paint_roof(RoofCover::gravel, size_px, derived_seed(seed, 11)))};
  city.trims = {add(paint_trim(size_px, derived_seed(seed, 8))), add(paint_trim(size_px, derived_seed(seed, 9)))};

  city.first_facade = static_cast<uint32_t>(city.images.size());
  uint64_t stream = 16;
  for (const FacadeStyle& style : facade_styles()) {
    for (cv::Mat& image : paint_facades(style, size_px, CityTextures::kFacadeVariants, derived_seed(seed, stream++))) {
      add(std::move(image));
    }
  }
  return city;
}

}  // namespace hedgehop::scenes::textures
