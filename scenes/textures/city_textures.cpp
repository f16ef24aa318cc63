#include "scenes/textures/city_textures.h"

#include <algorithm>
#include <utility>

#include "scenes/textures/canvas.h"
#include "scenes/textures/facade_textures.h"
#include "scenes/textures/street_textures.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes::textures {

namespace {

const Color kStone{0.62f, 0.59f, 0.54f};
const Color kDark{0.08f, 0.08f, 0.09f};

Color sign_color(Random& random) {
  static const Color colors[] = {{0.65f, 0.14f, 0.12f}, {0.12f, 0.28f, 0.52f}, {0.14f, 0.40f, 0.24f},
                                 {0.82f, 0.62f, 0.16f}, {0.22f, 0.20f, 0.20f}, {0.85f, 0.83f, 0.78f}};
  return varied(colors[uniform_index(random, 6)], 0.15, random);
}

// A sign above the shop, with blocks that resemble letters at a distance.
void paint_sign(Canvas& canvas, const Area& board, Random& random) {
  const Color ground = sign_color(random);
  const bool light_letters = ground[0] + ground[1] + ground[2] < 1.5f;
  const Color letter = light_letters ? Color{0.92f, 0.90f, 0.84f} : Color{0.15f, 0.12f, 0.12f};
  canvas.fill(board, ground);
  double x = board.left + uniform(random, 0.15, 0.6);
  const double end = board.left + board.width - uniform(random, 0.15, 0.6);
  while (x < end - 0.2) {
    const double width = uniform(random, 0.10, 0.24);
    const double top = board.top + (chance(random, 0.5) ? 0.12 : 0.20);
    const Area glyph{x, top, width, board.top + board.height - 0.12 - top};
    canvas.fill(glyph, letter);
    if (chance(random, 0.6)) canvas.fill({x + 0.06, top + 0.08, width - 0.06, 0.08}, ground);
    x += width + (chance(random, 0.15) ? 0.25 : 0.06);
  }
}

void paint_display(Canvas& canvas, const Area& glass, Random& random) {
  canvas.fill(glass, chance(random, 0.4) ? Color{0.80f, 0.70f, 0.48f} : Color{0.16f, 0.18f, 0.20f});
  for (int k = 0; k < 22; ++k) {  // goods on three shelves
    const double width = uniform(random, 0.08, 0.35), height = uniform(random, 0.1, 0.5);
    const double shelf = glass.top + glass.height * (1 + uniform_index(random, 3)) / 3.0;
    canvas.fill({glass.left + uniform(random, 0.0, glass.width - width), shelf - height, width, height},
                sign_color(random), 0.9);
  }
  canvas.fade(glass, {0.75f, 0.82f, 0.88f}, uniform(random, 0.1, 0.5), 0.0);
  canvas.outline(glass, 0.07, {0.20f, 0.20f, 0.21f});
  canvas.fill({glass.left + 0.5 * glass.width - 0.03, glass.top, 0.06, glass.height}, {0.20f, 0.20f, 0.21f});
}

void paint_shutter(Canvas& canvas, const Area& opening, Random& random) {
  const Color metal = varied({0.55f, 0.56f, 0.56f}, 0.25, random);
  canvas.fill(opening, metal);
  for (double y = 0.0; y < opening.height - 0.05; y += 0.12) {
    canvas.fill({opening.left, opening.top + y, opening.width, 0.05}, scaled(metal, 0.65));
  }
  for (int k = 0; k < 5; ++k) {  // graffiti
    canvas.crack(opening.left + opening.width * uniform(random, 0.3, 0.7),
                 opening.top + opening.height * uniform(random, 0.3, 0.7), 1.2, 0.09, sign_color(random), 0.9, random);
  }
}

void paint_door(Canvas& canvas, const Area& door, Random& random) {
  const Color leaf = sign_color(random);
  canvas.fill(door, leaf);
  canvas.outline(door, 0.08, scaled(leaf, 0.5));
  canvas.fill({door.left + 0.2, door.top + 0.25, door.width - 0.4, 0.9}, {0.14f, 0.17f, 0.20f});
}

void paint_shop(Canvas& canvas, const Area& bay, Random& random) {
  const double pillar = 0.3, plinth = 0.45;
  const Area opening{bay.left + pillar, bay.top + 1.0, bay.width - 2.0 * pillar, bay.height - 1.0 - plinth};
  paint_sign(canvas, {opening.left, bay.top + 0.30, opening.width, 0.60}, random);
  const double kind = uniform(random, 0.0, 1.0);
  if (kind < 0.2) {
    paint_shutter(canvas, opening, random);
  } else {
    const double door = 1.0, door_left = chance(random, 0.5) ? opening.left : opening.left + opening.width - door;
    const double glass_left = door_left == opening.left ? opening.left + door : opening.left;
    paint_display(canvas, {glass_left, opening.top, opening.width - door, opening.height}, random);
    paint_door(canvas, {door_left, opening.top, door, opening.height + plinth}, random);
  }
  if (kind > 0.6) {  // an awning
    const Color cloth = sign_color(random);
    for (double x = 0.0; x < opening.width - 0.01; x += 0.4) {
      const double strip = std::min(0.2, opening.width - x), gap = std::clamp(opening.width - x - 0.2, 0.0, 0.2);
      canvas.fill({opening.left + x, opening.top - 0.15, strip, 0.75}, cloth);
      canvas.fill({opening.left + x + 0.2, opening.top - 0.15, gap, 0.75}, {0.88f, 0.86f, 0.80f});
    }
    canvas.fade({opening.left, opening.top + 0.6, opening.width, 0.35}, kDark, 0.6, 0.0);
  }
  canvas.fade({opening.left, opening.top, opening.width, 0.2}, kDark, 0.5, 0.0);
}

}  // namespace

cv::Mat paint_trim(int size_px, uint64_t seed) {
  Random random(seed);
  Canvas canvas(size_px, kTrimTileM, varied(kStone, 0.12, random));
  canvas.shade(fractal_noise(size_px, {4, 4, 8, 0.75}, random), 0.10);
  canvas.stain(fractal_noise(size_px, {48, 4, 4, 0.7}, random), 0.5, 2.0, {0.14f, 0.12f, 0.11f}, 0.5);

  // Shops: plinth, joints of the pillars, then the fronts between them.
  for (int strip = 0; strip < kShopStrips; ++strip) {
    const double top = strip * kShopM;
    canvas.fill({0.0, top + kShopM - 0.45, kTrimTileM, 0.45}, {0.28f, 0.27f, 0.26f}, 0.75);
    for (double y = top + 0.5; y < top + kShopM; y += 0.5) canvas.fill({0.0, y, kTrimTileM, 0.03}, kDark, 0.5);
    canvas.fill({0.0, top, kTrimTileM, 0.18}, {0.76f, 0.74f, 0.68f});
    canvas.fade({0.0, top + 0.18, kTrimTileM, 0.12}, kDark, 0.5, 0.0);
    const double bay = kTrimTileM / kShopBays;
    for (int k = 0; k < kShopBays; ++k) paint_shop(canvas, {k * bay, top, bay, kShopM}, random);
  }

  // Cornice: coping, frieze with blocks, shadow on the wall below.
  const double top = kShopStrips * kShopM;
  canvas.fill({0.0, top, kTrimTileM, 0.22}, {0.78f, 0.76f, 0.71f});
  canvas.fade({0.0, top + 0.22, kTrimTileM, 0.10}, kDark, 0.6, 0.1);
  for (double x = 0.0; x < kTrimTileM; x += 0.6) {
    canvas.fill({x + 0.1, top + 0.30, 0.28, 0.25}, varied({0.74f, 0.72f, 0.66f}, 0.15, random));
    canvas.fill({x + 0.38, top + 0.30, 0.08, 0.25}, kDark, 0.5);
  }
  canvas.fade({0.0, top + 0.55, kTrimTileM, 0.20}, kDark, 0.15, 0.5);
  canvas.shade(fractal_noise(size_px, {32, 32, 5, 0.9}, random), 0.06);
  return canvas.finished();
}

CityTextures city_textures(int size_px, uint64_t seed, bool wear) {
  CityTextures city{.images = TextureList(size_px)};
  const auto add = [&](cv::Mat (*paint)(int, uint64_t), uint64_t stream) {
    const uint64_t image_seed = derived_seed(seed, stream);
    return city.images.add([=] { return paint(size_px, image_seed); });
  };
  const auto add_roof = [&](RoofCover cover, uint64_t stream) {
    const uint64_t image_seed = derived_seed(seed, stream);
    return city.images.add([=] { return paint_roof(cover, size_px, image_seed); });
  };

  city.streets = {add(paint_street, 0), add(paint_street, 1)};
  city.crossing = add(paint_crossing, 2);
  city.lots = {add(paint_paved_lot, 3), add(paint_parking_lot, 4), add(paint_garden_lot, 5)};
  city.grass = add(paint_grass, 6);
  city.field = add(paint_field, 10);
  city.roofs = {add_roof(RoofCover::felt, 7), add_roof(RoofCover::gravel, 11)};
  city.trims = {add(paint_trim, 8), add(paint_trim, 9)};

  city.first_facade = static_cast<uint32_t>(city.images.size());
  uint64_t stream = 16;
  for (const FacadeStyle& style : facade_styles()) {
    const uint64_t image_seed = derived_seed(seed, stream++);
    city.images.add(CityTextures::kFacadeVariants,
                    [=] { return paint_facades(style, size_px, CityTextures::kFacadeVariants, image_seed); });
  }
  if (wear) city.repairs = add(paint_repairs, 12);
  return city;
}

}  // namespace hedgehop::scenes::textures
