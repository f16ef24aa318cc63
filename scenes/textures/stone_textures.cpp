#include "scenes/textures/stone_textures.h"

#include <cmath>

#include "scenes/textures/canvas.h"
#include "scenes/textures/surface_patterns.h"

namespace hedgehop::scenes::textures {

cv::Mat paint_rock(int size_px, uint64_t seed) {
  Random random(seed);
  const double tile = kRockTileM;
  Canvas canvas(size_px, tile, {0.50f, 0.48f, 0.45f});
  canvas.shade(fractal_noise(size_px, {3, 3, 8, 0.8}, random), 0.22);
  canvas.stain(fractal_noise(size_px, {5, 9, 6, 0.75}, random), 0.6, 0.8, {0.22f, 0.20f, 0.19f}, 0.7);
  canvas.stain(fractal_noise(size_px, {6, 6, 6, 0.75}, random), 1.0, 0.5, {0.62f, 0.62f, 0.42f}, 0.7);  // lichen
  for (int k = 0; k < 14; ++k) {
    canvas.crack(uniform(random, 0.0, tile), uniform(random, 0.0, tile), uniform(random, 0.3, 1.2), 0.015,
                 {0.10f, 0.10f, 0.10f}, 0.7, random);
  }
  return canvas.finished();
}

cv::Mat paint_asphalt_road(int size_px, uint64_t seed) {
  Random random(seed);
  Canvas canvas(size_px, kAsphaltTileM, kAsphalt);
  paint_worn_asphalt(canvas, {0.14, 6, 12, 0.7, {0.12f, 0.12f, 0.12f}}, random);
  return canvas.finished();
}

cv::Mat paint_brick_wall(int size_px, uint64_t seed) {
  Random random(seed);
  Canvas canvas(size_px, kWallTileM, {0.55f, 0.28f, 0.21f});
  paint_masonry(canvas, {16, 48, 0.012, 0.30}, {0.58f, 0.29f, 0.21f}, {0.72f, 0.69f, 0.64f}, random);
  // No variation as large as the texture, which would make its repetition visible.
  canvas.shade(fractal_noise(size_px, {32, 32, 5, 0.8}, random), 0.10);
  return canvas.finished();
}

cv::Mat paint_clouded_wall(int size_px, uint64_t seed) {
  Random random(seed);
  Canvas canvas(size_px, kWallTileM, {0.55f, 0.54f, 0.52f});
  canvas.shade(fractal_noise(size_px, {4, 4, 2, 0.4}, random), 0.22);
  return canvas.finished();
}

cv::Mat paint_blank(int size_px, const cv::Vec3f& color) { return Canvas(size_px, 1.0, color).finished(); }

cv::Mat faded(const cv::Mat& image, double strength) {
  const cv::Scalar mean = cv::mean(image);
  cv::Mat3b result = image.clone();
  for (cv::Vec3b& pixel : result) {
    for (int k = 0; k < 3; ++k) pixel[k] = static_cast<uint8_t>(std::lround(mean[k] + strength * (pixel[k] - mean[k])));
  }
  return result;
}

}  // namespace hedgehop::scenes::textures
