#include "scenes/textures/room_textures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "scenes/textures/canvas.h"
#include "scenes/textures/surface_patterns.h"

namespace hedgehop::scenes::textures {
namespace {

const Color kWood{0.52f, 0.34f, 0.19f};
const Color kRoomDark{0.08f, 0.07f, 0.06f};
const Color kCream{0.86f, 0.82f, 0.72f};

Color vivid(Random& random) {
  static const Color colors[] = {{0.70f, 0.18f, 0.14f}, {0.14f, 0.30f, 0.52f}, {0.16f, 0.42f, 0.26f},
                                 {0.82f, 0.62f, 0.18f}, {0.38f, 0.20f, 0.36f}, {0.84f, 0.80f, 0.70f},
                                 {0.12f, 0.12f, 0.14f}};
  return varied(colors[uniform_index(random, 7)], 0.25, random);
}

void paint_paper(Canvas& canvas, WallPaper paper, Random& random) {
  const double tile = canvas.tile_m();
  const int size_px = canvas.size_px();
  switch (paper) {
    case WallPaper::stripes:
      for (int k = 0; k < 20; ++k) {
        canvas.fill({0.2 * k, 0.0, 0.2, tile},
                    varied(k % 2 == 0 ? Color{0.62f, 0.70f, 0.66f} : Color{0.80f, 0.80f, 0.70f}, 0.08, random));
        canvas.fill({0.2 * k, 0.0, 0.012, tile}, {0.32f, 0.42f, 0.40f});
        for (double y = 0.05 + 0.1 * (k % 2); y < tile; y += 0.2) {
          canvas.disc(0.2 * k + 0.1, y, uniform(random, 0.018, 0.035), {0.42f, 0.24f, 0.22f}, 0.8);
        }
      }
      break;
    case WallPaper::brick:
      paint_masonry(canvas, {16, 50, 0.012, 0.32}, {0.58f, 0.30f, 0.22f}, {0.74f, 0.71f, 0.66f}, random);
      break;
    case WallPaper::damask:
      canvas.fill({0.0, 0.0, tile, tile}, {0.58f, 0.42f, 0.34f});
      for (int row = 0; row < 10; ++row) {
        for (int column = 0; column < 10; ++column) {
          const double x = 0.4 * column + (row % 2) * 0.2 + uniform(random, -0.03, 0.03),
                       y = 0.4 * row + uniform(random, -0.03, 0.03);
          const Color ornament = varied({0.80f, 0.68f, 0.48f}, 0.2, random);
          canvas.disc(x, y, 0.10, ornament, 0.9);
          canvas.disc(x, y, 0.06, {0.45f, 0.30f, 0.24f}, 0.9);
          for (int leaf = 0; leaf < 6; ++leaf) {
            const double angle = leaf * std::numbers::pi / 3.0;
            canvas.disc(x + 0.14 * std::cos(angle), y + 0.14 * std::sin(angle), uniform(random, 0.025, 0.05), ornament,
                        0.9);
          }
        }
      }
      break;
    case WallPaper::plaster:
      canvas.stain(fractal_noise(size_px, {5, 5, 8, 0.75}, random), 0.0, 2.0, {0.52f, 0.54f, 0.56f}, 0.9);
      canvas.stain(fractal_noise(size_px, {4, 4, 7, 0.7}, random), 0.9, 0.3, {0.50f, 0.36f, 0.28f}, 0.8);
      for (int k = 0; k < 12; ++k) {
        canvas.crack(uniform(random, 0.0, tile), uniform(random, 0.0, tile), uniform(random, 0.4, 1.6), 0.014,
                     kRoomDark, 0.6, random);
      }
      break;
  }
  canvas.shade(fractal_noise(size_px, {4, 4, 8, 0.8}, random), 0.09);
}

// Skirting board and wear along the wall.
void paint_skirting(Canvas& canvas) {
  const double tile = canvas.tile_m();
  canvas.fade({0.0, tile - 0.5, tile, 0.38}, kRoomDark, 0.0, 0.35);
  canvas.fill({0.0, tile - 0.14, tile, 0.14}, {0.36f, 0.25f, 0.16f});
  canvas.fill({0.0, tile - 0.14, tile, 0.02}, {0.70f, 0.58f, 0.42f});
}

// A framed image: horizon and discs.
void paint_framed_image(Canvas& canvas, const Area& frame, Random& random) {
  canvas.fade({frame.left + 0.03, frame.top + frame.height, frame.width, 0.10}, kRoomDark, 0.5, 0.0);
  canvas.fill(frame, varied(kWood, 0.4, random));
  const Area inside{frame.left + 0.06, frame.top + 0.06, frame.width - 0.12, frame.height - 0.12};
  canvas.fill(inside, vivid(random));
  canvas.fill({inside.left, inside.top + 0.6 * inside.height, inside.width, 0.4 * inside.height}, vivid(random));
  for (int k = 0; k < 16; ++k) {
    const double r = uniform(random, 0.02, 0.2 * std::min(inside.width, inside.height));
    canvas.disc(inside.left + uniform(random, r, inside.width - r), inside.top + uniform(random, r, inside.height - r),
                r, vivid(random), 0.85);
  }
}

void paint_board_with_notes(Canvas& canvas, const Area& board, Random& random) {
  canvas.fill(board, {0.66f, 0.50f, 0.32f});
  canvas.outline(board, 0.05, {0.30f, 0.20f, 0.12f});
  for (int k = 0; k < 12; ++k) {
    const Area note{board.left + uniform(random, 0.08, board.width - 0.38),
                    board.top + uniform(random, 0.08, board.height - 0.38), uniform(random, 0.12, 0.28),
                    uniform(random, 0.15, 0.28)};
    canvas.fill(note, varied({0.88f, 0.87f, 0.80f}, 0.15, random));
    for (double y = 0.04; y < note.height - 0.03; y += 0.035) {
      canvas.fill({note.left + 0.02, note.top + y, note.width * uniform(random, 0.4, 0.85), 0.012}, kRoomDark, 0.7);
    }
  }
}

void paint_wood(Canvas& canvas, Random& random) {
  const int size_px = canvas.size_px();
  canvas.shade(fractal_noise(size_px, {4, 48, 4, 0.8}, random), 0.13);
  canvas.shade(fractal_noise(size_px, {4, 4, 7, 0.7}, random), 0.07);
}

}  // namespace

std::vector<cv::Mat> paint_room_walls(WallPaper paper, int size_px, int variants, uint64_t seed) {
  Random paper_random(derived_seed(seed, 0));
  Canvas wall(size_px, kRoomTileM, kCream);
  paint_paper(wall, paper, paper_random);
  paint_skirting(wall);
  const cv::Mat1f grain = fractal_noise(size_px, {48, 48, 4, 1.0}, paper_random);

  std::vector<cv::Mat> images;
  for (int k = 0; k < variants; ++k) {
    Random random(derived_seed(seed, static_cast<uint64_t>(k) + 1));
    Canvas canvas = k + 1 < variants ? wall : std::move(wall);
    for (double left : {0.2, 2.2}) {  // two objects side by side, 1 to 3 m above the floor
      const double width = uniform(random, 0.7, 1.4), height = uniform(random, 0.6, 1.1);
      const Area thing{left + uniform(random, 0.0, 1.6 - width), uniform(random, 1.4, 2.4 - 0.5 * height), width,
                       height};
      if (chance(random, 0.35)) {
        paint_board_with_notes(canvas, thing, random);
      } else {
        paint_framed_image(canvas, thing, random);
      }
    }
    for (int scuff = 0; scuff < 14; ++scuff) {
      canvas.crack(uniform(random, 0.4, 3.6), uniform(random, 2.6, 3.5), uniform(random, 0.1, 0.35), 0.015, kRoomDark,
                   0.4, random);
    }
    canvas.shade(grain, 0.06);
    images.push_back(canvas.finished());
  }
  return images;
}

cv::Mat paint_parquet(int size_px, uint64_t seed) {
  Random random(seed);
  Canvas canvas(size_px, kRoomTileM, kWood);
  paint_masonry(canvas, {32, 4, 0.008, 0.30, 0.0}, kWood, scaled(kWood, 0.3), random);
  for (int k = 0; k < 32; ++k) {  // each row of planks has different joints
    const double x = 0.125 * k;
    for (int end = 0; end < 3; ++end) {
      const double y = uniform(random, 0.0, kRoomTileM);
      canvas.fill({x, y, 0.125, uniform(random, 0.3, 1.2)}, varied(kWood, 0.35, random), 0.8);
      canvas.fill({x, y, 0.125, 0.01}, kRoomDark, 0.8);
    }
    canvas.fill({x, 0.0, 0.008, kRoomTileM}, kRoomDark, 0.7);
  }
  canvas.shade(fractal_noise(size_px, {64, 4, 4, 0.85}, random), 0.12);
  canvas.shade(fractal_noise(size_px, {3, 3, 8, 0.75}, random), 0.09);
  for (int k = 0; k < 25; ++k) {
    canvas.disc(uniform(random, 0.0, 4.0), uniform(random, 0.0, 4.0), uniform(random, 0.008, 0.025), kRoomDark, 0.7);
  }
  return canvas.finished();
}

cv::Mat paint_carpet(int size_px, uint64_t seed) {
  Random random(seed);
  Canvas canvas(size_px, kRoomTileM, {0.36f, 0.37f, 0.42f});
  paint_masonry(canvas, {8, 8, 0.012, 0.22, 0.0}, {0.36f, 0.37f, 0.42f}, {0.18f, 0.18f, 0.22f}, random);
  for (int k = 0; k < 260; ++k) {
    canvas.fill({uniform(random, 0.0, 4.0), uniform(random, 0.0, 4.0), uniform(random, 0.02, 0.14),
                 uniform(random, 0.02, 0.14)},
                varied({0.58f, 0.50f, 0.42f}, 0.4, random), 0.7);
  }
  canvas.shade(fractal_noise(size_px, {4, 4, 8, 0.85}, random), 0.15);
  return canvas.finished();
}

cv::Mat paint_ceiling(int size_px, uint64_t seed) {
  Random random(seed);
  Canvas canvas(size_px, kRoomTileM, kCream);
  paint_masonry(canvas, {8, 8, 0.03, 0.06, 0.0}, {0.84f, 0.84f, 0.81f}, {0.50f, 0.50f, 0.50f}, random);
  for (int k = 0; k < 2200; ++k) {
    canvas.disc(uniform(random, 0.0, 4.0), uniform(random, 0.0, 4.0), uniform(random, 0.006, 0.018),
                {0.35f, 0.35f, 0.34f}, 0.7);
  }
  canvas.stain(fractal_noise(size_px, {3, 3, 6, 0.65}, random), 1.1, 0.5, {0.64f, 0.56f, 0.42f}, 0.5);
  canvas.fill({1.5, 1.5, 1.0, 0.5}, {0.98f, 0.98f, 0.95f});
  canvas.outline({1.5, 1.5, 1.0, 0.5}, 0.04, {0.40f, 0.40f, 0.40f});
  canvas.shade(fractal_noise(size_px, {4, 4, 8, 0.8}, random), 0.05);
  return canvas.finished();
}

cv::Mat paint_shelves(int size_px, uint64_t seed) {
  Random random(seed);
  Canvas canvas(size_px, kRoomTileM, scaled(kWood, 0.35));
  constexpr double kShelfM = 0.4;
  for (double shelf = kShelfM; shelf < kRoomTileM + 0.01; shelf += kShelfM) {
    for (double x = 0.0; x < kRoomTileM;) {
      const double width = uniform(random, 0.025, 0.085), height = uniform(random, 0.20, 0.34);
      if (!chance(random, 0.08)) {
        const Color spine = vivid(random);
        canvas.fill({x, shelf - height, width - 0.006, height - 0.03}, spine);
        canvas.fill({x, shelf - 0.75 * height, width - 0.006, 0.035}, varied({0.80f, 0.72f, 0.50f}, 0.3, random), 0.8);
      }
      x += width;
    }
    canvas.fill({0.0, shelf - 0.03, kRoomTileM, 0.03}, kWood);
    canvas.fade({0.0, shelf, kRoomTileM, 0.12}, kRoomDark, 0.6, 0.0);
  }
  for (double x = 0.0; x < kRoomTileM; x += 1.0) canvas.fill({x, 0.0, 0.035, kRoomTileM}, kWood);
  canvas.shade(fractal_noise(size_px, {4, 4, 8, 0.8}, random), 0.07);
  return canvas.finished();
}

cv::Mat paint_drawers(int size_px, uint64_t seed) {
  Random random(seed);
  Canvas canvas(size_px, kRoomTileM, kWood);
  paint_wood(canvas, random);
  for (int row = 0; row < 10; ++row) {
    for (int column = 0; column < 5; ++column) {
      const Area front{0.8 * column + 0.02, 0.4 * row + 0.02, 0.76, 0.36};
      canvas.fill(front, varied({0.60f, 0.42f, 0.26f}, 0.30, random), 0.7);
      canvas.outline(front, 0.02, kRoomDark, 0.7);
      canvas.disc(front.left + 0.38, front.top + 0.18, 0.035, {0.82f, 0.76f, 0.58f});
      if (chance(random, 0.4)) {
        canvas.fill({front.left + 0.1, front.top + 0.1, 0.16, 0.08}, {0.90f, 0.88f, 0.80f});
      }
    }
  }
  canvas.shade(fractal_noise(size_px, {4, 48, 4, 0.8}, random), 0.10);
  canvas.shade(fractal_noise(size_px, {4, 4, 8, 0.8}, random), 0.06);
  return canvas.finished();
}

}  // namespace hedgehop::scenes::textures
