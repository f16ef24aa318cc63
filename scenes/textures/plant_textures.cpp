#include "scenes/textures/plant_textures.h"

#include "scenes/textures/canvas.h"

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

  // From the depth of the crown to its surface, ever lighter; each leaf on its own shadow.
  for (int k = 0; k < style.leaves; ++k) {
    const double height = static_cast<double>(k) / style.leaves;
    const Color tone = style.leaf + (style.light - style.leaf) * static_cast<float>(height * uniform(random, 0.2, 1.0));
    const double x = uniform(random, 0.0, tile), y = uniform(random, 0.0, tile);
    const double radius = uniform(random, style.smallest_m, style.largest_m);
    canvas.disc(x + 0.3 * radius, y + 0.5 * radius, radius, style.shade, 0.45);
    canvas.disc(x, y, radius, varied(scaled(tone, 0.45 + 0.55 * height), 0.3, random), 0.95);
  }
  // Twigs and boughs in light and shadow: structure for all distances.
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

}  // namespace hedgehop::scenes::textures
