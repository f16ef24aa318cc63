#include "scenes/textures/surface_patterns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace hedgehop::scenes::textures {

namespace {

// Returns the share of a pixel covered by joints, which are centered on the multiples of `period_m`.
float joint_share(double at_m, double pixel_m, double period_m, double joint_m) {
  const double from_joint_m = std::abs(at_m - period_m * std::round(at_m / period_m));
  const double overlap_m = 0.5 * (joint_m + pixel_m) - from_joint_m;
  return static_cast<float>(std::clamp(overlap_m / pixel_m, 0.0, std::min(1.0, joint_m / pixel_m)));
}

}  // namespace

void paint_masonry(Canvas& canvas, const Masonry& masonry, const Color& block, const Color& joint, Random& random) {
  std::vector<Color> tones;
  for (int k = 0; k < masonry.rows * masonry.columns; ++k) tones.push_back(varied(block, masonry.spread, random));

  const double pixel_m = canvas.tile_m() / canvas.size_px();
  const double width_m = canvas.tile_m() / masonry.columns, height_m = canvas.tile_m() / masonry.rows;
  const std::vector<double> centers_m = canvas.pixel_centers_m();
  struct Column {
    int block;
    float in_joint;
  };
  std::array<std::vector<Column>, 2> columns;  // of the pixels in even and odd rows of blocks
  for (size_t odd = 0; odd < 2; ++odd) {
    for (const double x : centers_m) {
      const double shifted = x + (odd == 1 ? masonry.bond * width_m : 0.0);
      columns[odd].push_back({static_cast<int>(shifted / width_m) % masonry.columns,
                              joint_share(shifted, pixel_m, width_m, masonry.joint_m)});
    }
  }
  std::vector<float> row_in_joint;
  for (const double y : centers_m) row_in_joint.push_back(joint_share(y, pixel_m, height_m, masonry.joint_m));
  canvas.paint([&](size_t r, size_t c) {
    const int row = std::min(static_cast<int>(centers_m[r] / height_m), masonry.rows - 1);
    const Column& column = columns[row % 2 == 1 ? 1 : 0][c];
    const Color& tone = tones[static_cast<size_t>(row * masonry.columns + column.block)];
    return tone + (joint - tone) * std::max(column.in_joint, row_in_joint[r]);
  });
}

void paint_worn_asphalt(Canvas& canvas, const AsphaltWear& wear, Random& random) {
  const double tile = canvas.tile_m();
  canvas.shade(fractal_noise(canvas.size_px(), {6, 6, 8, 0.85}, random), wear.mottling);
  for (int k = 0; k < wear.patches; ++k) {
    canvas.fill(
        {uniform(random, 0.0, tile), uniform(random, 0.0, tile), uniform(random, 0.5, 1.8), uniform(random, 0.5, 1.8)},
        varied(kAsphalt, 0.35, random), 0.8);
  }
  for (int k = 0; k < wear.cracks; ++k) {
    canvas.crack(uniform(random, 0.0, tile), uniform(random, 0.0, tile), uniform(random, 1.0, 4.0), 0.035, wear.crack,
                 wear.crack_opacity, random);
  }
}

}  // namespace hedgehop::scenes::textures
