#pragma once

#include "scenes/canvas.h"

namespace hedgehop::scenes {

/// Rows of equal blocks with joints between them: bricks, ashlar, slabs, tiles, planks.
struct Masonry {
  int columns = 50;  ///< blocks across the picture
  int rows = 144;    ///< blocks down the picture
  double joint_m = 0.015;
  double spread = 0.25;  ///< of the blocks' brightness
  double bond = 0.5;     ///< shift of every other row, in blocks
};

/// Covers the canvas. Every block has a tone of its own.
void paint_masonry(Canvas& canvas, const Masonry& masonry, const Colour& block, const Colour& joint, Random& random);

}  // namespace hedgehop::scenes
