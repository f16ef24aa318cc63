#pragma once

#include "scenes/textures/canvas.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes::textures {

/// Rows of equal blocks with joints between them: bricks, ashlar, slabs, tiles, planks.
struct Masonry {
  int columns = 50;  ///< blocks across the image
  int rows = 144;    ///< blocks down the image
  double joint_m = 0.015;
  double spread = 0.25;  ///< relative variation of the blocks' brightness
  double bond = 0.5;     ///< offset of alternate rows, in blocks
};

/// Covers the canvas with blocks of random tones.
void paint_masonry(Canvas& canvas, const Masonry& masonry, const Color& block, const Color& joint, Random& random);

/// Wear of an asphalt surface.
struct AsphaltWear {
  double mottling = 0.11;  ///< strength of the noise
  int patches = 5;
  int cracks = 10;
  double crack_opacity = 0.6;
  Color crack{0.10f, 0.10f, 0.10f};
};

inline const Color kAsphalt{0.37f, 0.37f, 0.38f};
inline const Color kGlass{0.10f, 0.13f, 0.16f};    ///< of windows
inline const Color kSkyGlow{0.62f, 0.72f, 0.82f};  ///< the sky mirrored in them

/// Paints mottling, patches and cracks over the entire canvas, whose background must be kAsphalt.
void paint_worn_asphalt(Canvas& canvas, const AsphaltWear& wear, Random& random);

}  // namespace hedgehop::scenes::textures
