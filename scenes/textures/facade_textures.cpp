#include "scenes/textures/facade_textures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scenes/textures/surface_patterns.h"

namespace hedgehop::scenes::textures {
namespace {

const Color kLamp{0.98f, 0.86f, 0.58f};
const Color kShadow{0.05f, 0.05f, 0.06f};

// Paints a random interior behind a pane: dark rooms, lamps, blinds or curtains.
void paint_interior(Canvas& canvas, const Area& pane, Random& random) {
  const double state = uniform(random, 0.0, 1.0);
  canvas.fill(pane, varied(kGlass, 0.4, random));
  if (state < 0.42) {  // sky in the glass
    canvas.fade(pane, varied(kSkyGlow, 0.15, random), uniform(random, 0.3, 0.9), uniform(random, 0.0, 0.3));
  } else if (state < 0.52) {  // lamp light
    canvas.fade(pane, varied(kLamp, 0.15, random), 0.8, 0.5);
    canvas.fill({pane.left + pane.width * uniform(random, 0.1, 0.6), pane.top + 0.45 * pane.height, 0.3 * pane.width,
                 0.55 * pane.height},
                {0.30f, 0.22f, 0.15f}, 0.8);
  } else if (state < 0.75) {  // a blind, drawn part of the way
    const double drawn = pane.height * uniform(random, 0.25, 1.0);
    const Color slat = varied({0.80f, 0.77f, 0.70f}, 0.15, random);
    canvas.fill({pane.left, pane.top, pane.width, drawn}, slat);
    for (double y = 0.0; y < drawn - 0.05; y += 0.12) {
      canvas.fill({pane.left, pane.top + y, pane.width, 0.04}, scaled(slat, 0.6));
    }
  } else {  // curtains, folded
    const Color cloth =
        varied(chance(random, 0.5) ? Color{0.78f, 0.72f, 0.62f} : Color{0.55f, 0.28f, 0.22f}, 0.3, random);
    const double reach = pane.width * uniform(random, 0.15, 0.5);
    for (double x = 0.0; x < reach; x += 0.10) {
      const double strip = std::min(0.10, reach - x);
      const Color fold = varied(cloth, 0.25, random);
      canvas.fill({pane.left + x, pane.top, strip, pane.height}, fold);
      canvas.fill({pane.left + pane.width - x - strip, pane.top, strip, pane.height}, scaled(fold, 0.92));
    }
  }
}

void paint_window(Canvas& canvas, const FacadeStyle& style, const Area& hole, Random& random) {
  const double frame = 0.07;
  paint_interior(canvas, hole, random);

  // Mullions, frame, and shadow of the reveal.
  for (int k = 1; k < style.panes_across; ++k) {
    canvas.fill({hole.left + hole.width * k / style.panes_across - 0.5 * frame, hole.top, frame, hole.height},
                style.trim_color);
  }
  for (int k = 1; k < style.panes_down; ++k) {
    canvas.fill({hole.left, hole.top + hole.height * k / style.panes_down - 0.5 * frame, hole.width, frame},
                style.trim_color);
  }
  canvas.outline(hole, frame, style.trim_color);
  canvas.fade({hole.left, hole.top, hole.width, 0.25}, kShadow, 0.65, 0.0);
  canvas.fade({hole.left, hole.top, 0.10, hole.height}, kShadow, 0.45, 0.35);
}

// Paints streaks of dirt that fade out above the end of the cell.
void paint_streaks(Canvas& canvas, const Area& below, Random& random) {
  const int count = 2 + uniform_index(random, 6);
  for (int k = 0; k < count; ++k) {
    const double width = uniform(random, 0.04, 0.25);
    const double x = below.left + uniform(random, 0.0, std::max(below.width - width, 0.01));
    canvas.fade({x, below.top, width, below.height * uniform(random, 0.3, 1.0)}, {0.12f, 0.10f, 0.08f},
                uniform(random, 0.15, 0.55), 0.0);
  }
}

void paint_balcony(Canvas& canvas, const Area& cell, const Area& hole, Random& random) {
  const double left = hole.left - 0.3, width = hole.width + 0.6;
  const double floor_y = std::min(hole.top + hole.height, cell.top + cell.height - 0.4);
  const Color rail = chance(random, 0.5) ? Color{0.16f, 0.17f, 0.18f} : Color{0.85f, 0.85f, 0.82f};
  if (chance(random, 0.4)) {
    canvas.fill({left, floor_y - 0.95, width, 0.95}, varied({0.55f, 0.62f, 0.60f}, 0.35, random), 0.85);
  }
  for (double x = 0.0; x < width; x += 0.16) canvas.fill({left + x, floor_y - 0.95, 0.05, 0.95}, rail);
  canvas.fill({left, floor_y - 1.0, width, 0.08}, rail);
  if (chance(random, 0.5)) {
    for (int k = 0; k < 14; ++k) {
      const double x = left + uniform(random, 0.15, width - 0.15);
      canvas.disc(x, floor_y - uniform(random, 0.75, 1.2), uniform(random, 0.06, 0.15),
                  varied({0.22f, 0.38f, 0.14f}, 0.5, random));
    }
  }
  canvas.fill({left, floor_y, width, 0.16}, {0.70f, 0.69f, 0.66f});
  canvas.fade({left, floor_y + 0.16, width, 0.24}, kShadow, 0.6, 0.0);
}

void paint_cell(Canvas& canvas, const FacadeStyle& style, const Area& cell, Random& random) {
  const Area hole{cell.left + 0.5 * cell.width * (1.0 - style.window_width),
                  cell.top + 0.45 * cell.height * (1.0 - style.window_height), cell.width * style.window_width,
                  cell.height * style.window_height};
  const double sill_y = hole.top + hole.height;
  const Area below{hole.left - 0.1, sill_y, hole.width + 0.2, cell.top + cell.height - sill_y};
  if (style.wall == FacadeStyle::Wall::glass) {
    canvas.fill(below, varied(style.wall_color, 0.35, random), 0.6);
    paint_window(canvas, style, hole, random);
    return;
  }

  paint_streaks(canvas, below, random);
  canvas.fill({hole.left - 0.12, hole.top - 0.22, hole.width + 0.24, 0.22}, style.trim_color, 0.8);
  paint_window(canvas, style, hole, random);
  canvas.fill({hole.left - 0.15, sill_y, hole.width + 0.3, 0.12}, style.trim_color);
  canvas.fade({hole.left - 0.15, sill_y + 0.12, hole.width + 0.3, 0.15}, kShadow, 0.55, 0.0);
  if (chance(random, style.balcony_share)) {
    paint_balcony(canvas, cell, hole, random);
  } else if (chance(random, 0.12)) {  // an air conditioner under the window
    const Area unit{hole.left + uniform(random, 0.0, 0.3), sill_y + 0.15, 0.75, 0.5};
    canvas.fill(unit, {0.82f, 0.82f, 0.80f});
    canvas.disc(unit.left + 0.3, unit.top + 0.25, 0.18, {0.25f, 0.26f, 0.27f});
  }
}

void paint_wall(Canvas& canvas, const FacadeStyle& style, Random& random) {
  switch (style.wall) {
    case FacadeStyle::Wall::brick:
      paint_masonry(canvas, {50, 144, 0.015, 0.28}, style.wall_color, {0.72f, 0.69f, 0.64f}, random);
      break;
    case FacadeStyle::Wall::ashlar:
      paint_masonry(canvas, {12, 24, 0.025, 0.14}, style.wall_color, scaled(style.wall_color, 0.55), random);
      break;
    case FacadeStyle::Wall::panel:
      paint_masonry(canvas, {style.bays, style.floors, 0.05, 0.10, 0.0}, style.wall_color,
                    scaled(style.wall_color, 0.4), random);
      break;
    case FacadeStyle::Wall::plaster:
    case FacadeStyle::Wall::glass:
      break;
  }
  if (style.floor_bands) {
    for (int k = 0; k < style.floors; ++k) {
      const double y = k * style.floor_m();
      canvas.fill({0.0, y - 0.15, FacadeStyle::kTileM, 0.25}, style.trim_color, 0.9);
      canvas.fade({0.0, y + 0.10, FacadeStyle::kTileM, 0.15}, kShadow, 0.5, 0.0);
    }
  }
}

void weather_wall(Canvas& canvas, Random& random) {
  canvas.shade(fractal_noise(canvas.size_px(), {3, 3, 8, 0.75}, random), 0.08);
  canvas.stain(fractal_noise(canvas.size_px(), {48, 3, 4, 0.7}, random), 0.6, 2.0, {0.16f, 0.14f, 0.12f}, 0.32);
  canvas.stain(fractal_noise(canvas.size_px(), {4, 4, 7, 0.7}, random), 1.2, 0.8, {0.80f, 0.77f, 0.72f}, 0.35);
}

}  // namespace

const std::vector<FacadeStyle>& facade_styles() {
  using Wall = FacadeStyle::Wall;
  static const std::vector<FacadeStyle> styles = {
      {Wall::brick, {0.58f, 0.27f, 0.20f}, {0.86f, 0.84f, 0.78f}, 5, 4, 0.44, 0.58, 2, 2, 0.0, false},
      {Wall::brick, {0.72f, 0.58f, 0.38f}, {0.30f, 0.27f, 0.24f}, 4, 4, 0.55, 0.50, 3, 1, 0.25, true},
      {Wall::plaster, {0.80f, 0.70f, 0.50f}, {0.90f, 0.88f, 0.82f}, 4, 4, 0.40, 0.60, 2, 3, 0.45, true},
      {Wall::plaster, {0.60f, 0.68f, 0.70f}, {0.92f, 0.92f, 0.90f}, 5, 4, 0.46, 0.52, 2, 1, 0.20, false},
      {Wall::panel, {0.60f, 0.59f, 0.56f}, {0.36f, 0.37f, 0.38f}, 4, 4, 0.68, 0.48, 3, 1, 0.15, false},
      {Wall::panel, {0.48f, 0.44f, 0.40f}, {0.82f, 0.80f, 0.76f}, 3, 4, 0.75, 0.55, 4, 1, 0.60, false},
      {Wall::ashlar, {0.70f, 0.64f, 0.54f}, {0.52f, 0.47f, 0.40f}, 4, 3, 0.42, 0.62, 2, 3, 0.10, true},
      {Wall::glass, {0.28f, 0.40f, 0.44f}, {0.66f, 0.69f, 0.70f}, 6, 4, 0.94, 0.70, 1, 2, 0.0, false},
  };
  return styles;
}

std::vector<cv::Mat> paint_facades(const FacadeStyle& style, int size_px, int variants, uint64_t seed) {
  Random wall_random(derived_seed(seed, 0));
  const Color wall_color = varied(style.wall_color, 0.06, wall_random);
  Canvas wall(size_px, FacadeStyle::kTileM, wall_color);
  paint_wall(wall, style, wall_random);
  weather_wall(wall, wall_random);
  const cv::Mat1f grain = fractal_noise(size_px, {32, 32, 5, 0.9}, wall_random);

  std::vector<cv::Mat> images;
  for (int k = 0; k < variants; ++k) {
    Random random(derived_seed(seed, static_cast<uint64_t>(k) + 1));
    Canvas canvas = k + 1 < variants ? wall : std::move(wall);
    for (int row = 0; row < style.floors; ++row) {
      for (int column = 0; column < style.bays; ++column) {
        paint_cell(canvas, style, {column * style.bay_m(), row * style.floor_m(), style.bay_m(), style.floor_m()},
                   random);
      }
    }
    canvas.shade(grain, 0.06);
    images.push_back(canvas.finished());
  }
  return images;
}

}  // namespace hedgehop::scenes::textures
