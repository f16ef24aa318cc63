#pragma once

#include "scenes/textures/canvas.h"

namespace hedgehop::scenes::textures {

/// Rows of equal blocks with joints between them: bricks, ashlar, slabs, tiles, planks.
struct Masonry {
  int columns = 50;  ///< blocks across the image
  int rows = 144;    ///< blocks down the image
  double joint_m = 0.015;
  double spread = 0.25;  ///< of the blocks' brightness
  double bond = 0.5;     ///< shift of every other row, in blocks
};

/// Covers the canvas. Every block has a tone of its own.
void paint_masonry(Canvas& canvas, const Masonry& masonry, const Color& block, const Color& joint, Random& random);

}  // namespace hedgehop::scenes::textures
