#include "scenes/textures/park_textures.h"

#include "scenes/textures/canvas.h"
#include "scenes/textures/surface_patterns.h"

namespace hedgehop::scenes::textures {

namespace {

struct LeafStyle {
  Color shade, leaf, light;
  double smallest_m, largest_m;
  int leaves;
};

LeafStyle style_of(Leaves leaves) {
  switch (leaves) {
    case Leaves::needles:
      return {{0.05f, 0.10f, 0.06f}, {0.16f, 0.30f, 0.16f}, {0.38f, 0.54f, 0.30f}, 0.015, 0.045, 7000};
    case Leaves::autumn:
      return {{0.12f, 0.08f, 0.03f}, {0.48f, 0.31f, 0.09f}, {0.85f, 0.64f, 0.20f}, 0.02, 0.06, 5000};
    case Leaves::broad:
      break;
  }
  return {{0.06f, 0.11f, 0.04f}, {0.24f, 0.40f, 0.12f}, {0.58f, 0.72f, 0.30f}, 0.02, 0.06, 5000};
}

}  // namespace

cv::Mat paint_leaves(Leaves leaves, int size_px, uint64_t seed) {
  Random random(seed);
  const LeafStyle style = style_of(leaves);
  const double tile = kLeafTileM;
  Canvas canvas(size_px, tile, style.shade);

  // Leaves get lighter from the interior of the crown to its surface. Each leaf casts a shadow.
  for (int k = 0; k < style.leaves; ++k) {
    const double height = static_cast<double>(k) / style.leaves;
    const Color tone = style.leaf + (style.light - style.leaf) * static_cast<float>(height * uniform(random, 0.2, 1.0));
    const double x = uniform(random, 0.0, tile), y = uniform(random, 0.0, tile);
    const double radius = uniform(random, style.smallest_m, style.largest_m);
    canvas.disc(x + 0.3 * radius, y + 0.5 * radius, radius, style.shade, 0.45);
    canvas.disc(x, y, radius, varied(scaled(tone, 0.45 + 0.55 * height), 0.3, random), 0.95);
  }
  // Light and shadow of twigs and branches, which give texture at all distances.
  canvas.shade(fractal_noise(size_px, {4, 4, 4, 0.8}, random), 0.22);
  canvas.stain(fractal_noise(size_px, {7, 7, 5, 0.8}, random), 0.9, 0.8, style.shade, 0.75);
  return canvas.finished();
}

cv::Mat paint_bark(int size_px, uint64_t seed) {
  Random random(seed);
  const double tile = kBarkTileM;
  const Color bark{0.36f, 0.29f, 0.22f}, furrow{0.10f, 0.08f, 0.06f};
  Canvas canvas(size_px, tile, bark);
  canvas.shade(fractal_noise(size_px, {24, 4, 5, 0.85}, random), 0.30);
  canvas.stain(fractal_noise(size_px, {20, 3, 5, 0.7}, random), 0.5, 0.5, furrow, 0.85);
  canvas.stain(fractal_noise(size_px, {3, 3, 6, 0.8}, random), 0.9, 0.9, {0.42f, 0.46f, 0.32f}, 0.6);  // moss
  canvas.shade(fractal_noise(size_px, {3, 3, 8, 0.8}, random), 0.12);
  return canvas.finished();
}

namespace {

const Color kTyre{0.06f, 0.06f, 0.06f};
const Color kRim{0.60f, 0.61f, 0.63f};

}  // namespace

cv::Mat paint_vehicle_body(const Color& paint, int size_px, uint64_t seed) {
  Random random(seed);
  const double tile = kVehicleTileM, ground = tile;
  Canvas canvas(size_px, tile, paint);
  canvas.fade({0.0, ground - 0.9, tile, 0.6}, {0.0f, 0.0f, 0.0f}, 0.0, 0.45);
  canvas.fill({0.0, ground - 0.30, tile, 0.30}, kTyre);  // the shadow below
  canvas.fill({0.0, ground - 0.40, tile, 0.10}, {0.16f, 0.16f, 0.17f});
  for (const double x : {0.0, 1.25, 2.5, 3.75}) {
    canvas.fill({x, ground - 1.2, 0.025, 0.8}, {0.05f, 0.05f, 0.05f}, 0.8);     // a door's gap
    canvas.fill({x + 0.15, ground - 0.80, 0.18, 0.05}, {0.75f, 0.75f, 0.76f});  // its handle
    canvas.fill({x + 0.5, ground - 0.72, 0.28, 0.14},
                x < 2.0 ? Color{0.80f, 0.20f, 0.10f} : Color{0.92f, 0.90f, 0.80f});
  }
  for (const double x : {0.75, 3.25}) {
    canvas.disc(x, ground - 0.32, 0.40, {0.04f, 0.04f, 0.04f});
    canvas.disc(x, ground - 0.32, 0.32, kTyre);
    canvas.disc(x, ground - 0.32, 0.20, kRim);
    for (int k = 0; k < 5; ++k)
      canvas.disc(x + uniform(random, -0.1, 0.1), ground - 0.32 + uniform(random, -0.1, 0.1), 0.03, kTyre);
  }
  canvas.shade(fractal_noise(size_px, {4, 4, 7, 0.75}, random), 0.06);
  return canvas.finished();
}

cv::Mat paint_vehicle_cabin(const Color& paint, int size_px, uint64_t seed) {
  Random random(seed);
  const double tile = kVehicleTileM, ground = tile;
  Canvas canvas(size_px, tile, paint);
  for (double x = 0.0; x < tile - 0.1; x += 1.25) {
    const Area pane{x + 0.08, ground - 1.42, 1.09, 0.46};
    canvas.fill(pane, kGlass);
    canvas.fade(pane, kSkyGlow, uniform(random, 0.3, 0.9), uniform(random, 0.0, 0.2));
    canvas.outline(pane, 0.03, {0.05f, 0.05f, 0.05f});
  }
  canvas.shade(fractal_noise(size_px, {4, 4, 7, 0.75}, random), 0.05);
  return canvas.finished();
}

}  // namespace hedgehop::scenes::textures
