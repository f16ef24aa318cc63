#include "scenes/textures/street_textures.h"

#include <algorithm>

#include "scenes/textures/canvas.h"
#include "scenes/textures/surface_patterns.h"

namespace hedgehop::scenes::textures {
namespace {

const Color kPaint{0.86f, 0.86f, 0.82f};
const Color kSlab{0.64f, 0.62f, 0.58f};
const Color kKerb{0.74f, 0.73f, 0.70f};
const Color kStreetDark{0.10f, 0.10f, 0.10f};
const Color kGrass{0.33f, 0.42f, 0.20f};
const Color kLeaf{0.18f, 0.30f, 0.10f};

constexpr double kPavementM = 1.4;
constexpr double kKerbM = 0.14;

// Worn asphalt with oil stains.
void paint_asphalt(Canvas& canvas, Random& random) {
  const double tile = canvas.tile_m();
  paint_worn_asphalt(canvas, {}, random);
  for (int k = 0; k < 25; ++k) {
    canvas.disc(uniform(random, 0.0, tile), uniform(random, 0.0, tile), uniform(random, 0.03, 0.22),
                chance(random, 0.6) ? kStreetDark : Color{0.48f, 0.47f, 0.45f}, uniform(random, 0.2, 0.6));
  }
}

void paint_slabs(Canvas& canvas, const Area& area, double slab, Random& random) {
  for (double y = 0.0; y < area.height - 1e-9; y += slab) {
    for (double x = 0.0; x < area.width - 1e-9; x += slab) {
      const Area one{area.left + x, area.top + y, std::min(slab, area.width - x), std::min(slab, area.height - y)};
      canvas.fill(one, varied(kSlab, 0.16, random));
      canvas.fill({one.left, one.top, one.width, 0.03}, kStreetDark, 0.45);
      canvas.fill({one.left, one.top, 0.03, one.height}, kStreetDark, 0.45);
      if (chance(random, 0.35)) {
        canvas.disc(one.left + uniform(random, 0.0, one.width), one.top + uniform(random, 0.0, one.height),
                    uniform(random, 0.02, 0.07), kStreetDark, 0.55);
      }
    }
  }
}

void paint_manhole(Canvas& canvas, double x, double y) {
  canvas.disc(x, y, 0.38, {0.42f, 0.40f, 0.37f});
  canvas.disc(x, y, 0.32, {0.16f, 0.15f, 0.15f});
  for (int k = -2; k <= 2; ++k) canvas.fill({x - 0.22, y + 0.1 * k - 0.02, 0.44, 0.04}, {0.42f, 0.40f, 0.37f});
}

void finish_ground(Canvas& canvas, Random& random) {
  canvas.shade(fractal_noise(canvas.size_px(), {3, 3, 8, 0.8}, random), 0.07);
}

void paint_bushes(Canvas& canvas, const Area& bed, int count, Random& random) {
  for (int k = 0; k < count; ++k) {
    const bool blossom = chance(random, 0.12);
    const Color petal = chance(random, 0.5) ? Color{0.85f, 0.75f, 0.30f} : Color{0.75f, 0.35f, 0.45f};
    canvas.disc(bed.left + uniform(random, 0.0, bed.width), bed.top + uniform(random, 0.0, bed.height),
                blossom ? uniform(random, 0.03, 0.06) : uniform(random, 0.06, 0.22),
                blossom ? petal : varied(kLeaf, 0.5, random), 0.9);
  }
}

void paint_lawn(Canvas& canvas, Random& random) {
  const int size_px = canvas.size_px();
  canvas.shade(fractal_noise(size_px, {3, 3, 9, 0.85}, random), 0.16);
  canvas.stain(fractal_noise(size_px, {5, 5, 7, 0.75}, random), 0.7, 1.2, {0.52f, 0.46f, 0.26f}, 0.6);
  canvas.stain(fractal_noise(size_px, {6, 6, 7, 0.75}, random), 0.7, 1.0, {0.20f, 0.30f, 0.12f}, 0.6);
  canvas.shade(fractal_noise(size_px, {64, 64, 4, 1.0}, random), 0.15);
}

}  // namespace

cv::Mat paint_street(int size_px, uint64_t seed) {
  Random random(seed);
  const double tile = kStreetTileM;
  Canvas canvas(size_px, tile, kAsphalt);
  paint_asphalt(canvas, random);

  // Wheel tracks, then worn paint.
  for (double x : {2.2, 3.2, 4.5, 5.5}) canvas.fill({x, 0.0, 0.4, tile}, kStreetDark, 0.18);
  for (double y : {0.5, 4.5}) canvas.fill({0.5 * tile - 0.07, y, 0.14, 2.2}, kPaint, 0.85);
  for (double x : {kPavementM + 0.30, tile - kPavementM - 0.42}) canvas.fill({x, 0.0, 0.12, tile}, kPaint, 0.7);
  paint_manhole(canvas, uniform(random, 2.3, 3.4), uniform(random, 1.0, 7.0));
  if (chance(random, 0.6)) paint_manhole(canvas, uniform(random, 4.7, 5.6), uniform(random, 1.0, 7.0));

  for (double left : {0.0, tile - kPavementM}) {
    paint_slabs(canvas, {left, 0.0, kPavementM, tile}, 0.5, random);
    const double kerb = left == 0.0 ? kPavementM - kKerbM : left;
    canvas.fill({kerb, 0.0, kKerbM, tile}, kKerb);
    for (double y = 0.0; y < tile; y += 1.0) canvas.fill({kerb, y, kKerbM, 0.04}, kStreetDark, 0.6);
  }
  finish_ground(canvas, random);
  return canvas.finished();
}

cv::Mat paint_crossing(int size_px, uint64_t seed) {
  Random random(seed);
  const double tile = kStreetTileM, far = tile - kPavementM;
  Canvas canvas(size_px, tile, kAsphalt);
  paint_asphalt(canvas, random);
  for (double x = kPavementM + 0.35; x < far - 0.5; x += 0.9) {
    for (double y : {0.15, tile - 1.35}) canvas.fill({x, y, 0.5, 1.2}, kPaint, 0.85);
    for (double y : {0.15, tile - 1.35}) canvas.fill({y, x, 1.2, 0.5}, kPaint, 0.85);
  }
  for (double left : {0.0, far}) {
    for (double top : {0.0, far}) {
      canvas.fill({left, top, kPavementM, kPavementM}, kKerb);
      const double inset_x = left == 0.0 ? 0.0 : kKerbM, inset_y = top == 0.0 ? 0.0 : kKerbM;
      paint_slabs(canvas, {left + inset_x, top + inset_y, kPavementM - kKerbM, kPavementM - kKerbM}, 0.42, random);
    }
  }
  paint_manhole(canvas, uniform(random, 3.0, 5.0), uniform(random, 3.0, 5.0));
  finish_ground(canvas, random);
  return canvas.finished();
}

cv::Mat paint_repairs(int size_px, uint64_t seed) {
  Random random(seed);
  const double tile = kGrassTileM;
  Canvas canvas(size_px, tile, kAsphalt);
  for (int k = 0; k < 60; ++k) {
    const Area patch{uniform(random, 0.0, tile), uniform(random, 0.0, tile), uniform(random, 0.6, 3.5),
                     uniform(random, 0.6, 3.5)};
    canvas.fill(patch, varied(kAsphalt, 0.5, random), uniform(random, 0.5, 1.0));
    canvas.outline(patch, 0.06, kStreetDark, 0.6);
  }
  for (int k = 0; k < 25; ++k) {
    canvas.crack(uniform(random, 0.0, tile), uniform(random, 0.0, tile), uniform(random, 1.0, 5.0), 0.05, kStreetDark,
                 0.8, random);
  }
  for (int k = 0; k < 90; ++k) {
    canvas.disc(uniform(random, 0.0, tile), uniform(random, 0.0, tile), uniform(random, 0.05, 0.45),
                chance(random, 0.6) ? kStreetDark : Color{0.62f, 0.60f, 0.56f}, uniform(random, 0.3, 0.7));
  }
  for (int k = 0; k < 6; ++k) paint_manhole(canvas, uniform(random, 0.0, tile), uniform(random, 0.0, tile));
  finish_ground(canvas, random);
  return canvas.finished();
}

cv::Mat paint_paved_lot(int size_px, uint64_t seed) {
  Random random(seed);
  const double tile = kLotTileM;
  Canvas canvas(size_px, tile, kSlab);
  paint_masonry(canvas, {16, 16, 0.03, 0.18, 0.5}, kSlab, scaled(kSlab, 0.5), random);
  for (double x : {0.0, 4.0}) canvas.fill({x, 0.0, 0.5, tile}, {0.42f, 0.26f, 0.20f}, 0.8);
  for (double y : {0.0, 4.0}) canvas.fill({0.0, y, tile, 0.5}, {0.42f, 0.26f, 0.20f}, 0.8);
  for (double x : {2.25, 6.25}) {
    const Area bed{x - 0.6, uniform(random, 1.3, 1.8), 1.2, 1.2};
    canvas.fill({bed.left - 0.1, bed.top - 0.1, 1.4, 1.4}, kKerb);
    canvas.fill(bed, {0.24f, 0.18f, 0.12f});
    paint_bushes(canvas, bed, 60, random);
  }
  canvas.stain(fractal_noise(size_px, {4, 4, 7, 0.7}, random), 1.0, 1.0, {0.22f, 0.21f, 0.19f}, 0.5);
  finish_ground(canvas, random);
  return canvas.finished();
}

cv::Mat paint_parking_lot(int size_px, uint64_t seed) {
  Random random(seed);
  const double tile = kLotTileM;
  Canvas canvas(size_px, tile, varied(kAsphalt, 0.1, random));
  paint_asphalt(canvas, random);
  paint_asphalt(canvas, random);
  for (double x = 0.0; x < tile; x += tile / 3.0) canvas.fill({x - 0.06, 0.3, 0.12, 4.6}, kPaint, 0.8);
  canvas.fill({0.0, 4.8, tile, 0.12}, kPaint, 0.8);
  finish_ground(canvas, random);
  return canvas.finished();
}

cv::Mat paint_garden_lot(int size_px, uint64_t seed) {
  Random random(seed);
  const double tile = kLotTileM;
  Canvas canvas(size_px, tile, kGrass);
  paint_lawn(canvas, random);
  paint_slabs(canvas, {3.4, 0.0, 1.0, tile}, 0.5, random);
  paint_bushes(canvas, {0.3, 0.4, 2.6, 1.1}, 140, random);
  paint_bushes(canvas, {5.2, 4.6, 1.2, 2.6}, 140, random);
  finish_ground(canvas, random);
  return canvas.finished();
}

cv::Mat paint_grass(int size_px, uint64_t seed) {
  Random random(seed);
  Canvas canvas(size_px, kGrassTileM, kGrass);
  paint_lawn(canvas, random);
  paint_bushes(canvas, {0.0, 0.0, kGrassTileM, kGrassTileM}, 120, random);
  return canvas.finished();
}

cv::Mat paint_field(int size_px, uint64_t seed) {
  Random random(seed);
  Canvas canvas(size_px, kGrassTileM, {0.60f, 0.52f, 0.28f});
  for (double x = 0.0; x < kGrassTileM; x += 0.5) canvas.fill({x, 0.0, 0.16, kGrassTileM}, {0.36f, 0.31f, 0.16f}, 0.6);
  for (double x : {3.9, 11.9}) canvas.fill({x, 0.0, 0.7, kGrassTileM}, {0.40f, 0.31f, 0.20f}, 0.8);
  canvas.shade(fractal_noise(size_px, {64, 16, 5, 0.9}, random), 0.14);
  canvas.stain(fractal_noise(size_px, {4, 4, 8, 0.75}, random), 0.6, 1.2, {0.40f, 0.42f, 0.18f}, 0.7);
  canvas.shade(fractal_noise(size_px, {3, 3, 9, 0.85}, random), 0.12);
  return canvas.finished();
}

cv::Mat paint_roof(RoofCover cover, int size_px, uint64_t seed) {
  Random random(seed);
  const double tile = kRoofTileM;
  Canvas canvas(size_px, tile, cover == RoofCover::felt ? Color{0.40f, 0.40f, 0.41f} : Color{0.64f, 0.60f, 0.54f});
  if (cover == RoofCover::felt) {
    for (double y = 0.0; y < tile; y += 1.0) canvas.fill({0.0, y, tile, 0.05}, kStreetDark, 0.5);
  } else {
    for (int k = 0; k < 3000; ++k) {
      canvas.disc(uniform(random, 0.0, tile), uniform(random, 0.0, tile), uniform(random, 0.03, 0.07),
                  varied({0.60f, 0.57f, 0.52f}, 0.4, random), 0.8);
    }
  }
  canvas.shade(fractal_noise(size_px, {4, 4, 8, 0.85}, random), 0.10);
  canvas.stain(fractal_noise(size_px, {3, 3, 6, 0.6}, random), 0.9, 0.6, {0.24f, 0.24f, 0.25f}, 0.6);
  for (int k = 0; k < 8; ++k) {
    const Area vent{uniform(random, 0.0, tile), uniform(random, 0.0, tile), uniform(random, 0.4, 1.3),
                    uniform(random, 0.4, 1.3)};
    canvas.fill({vent.left + 0.15, vent.top + 0.15, vent.width, vent.height}, kStreetDark, 0.6);
    canvas.fill(vent, varied({0.72f, 0.72f, 0.72f}, 0.2, random));
    canvas.outline(vent, 0.08, {0.40f, 0.41f, 0.42f});
  }
  return canvas.finished();
}

}  // namespace hedgehop::scenes::textures
