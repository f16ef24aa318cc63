#include "scenes/textures/vehicle_textures.h"

namespace hedgehop::scenes::textures {
namespace {

const Color kTyre{0.06f, 0.06f, 0.06f};
const Color kRim{0.60f, 0.61f, 0.63f};
const Color kGlass{0.10f, 0.13f, 0.16f};
const Color kSkyGlow{0.62f, 0.72f, 0.82f};

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
