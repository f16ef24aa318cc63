#pragma once

#include "scenes/textures/canvas.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes::textures {

/// How worn an area of asphalt looks.
struct AsphaltWear {
  double mottling = 0.11;  ///< strength of the noise
  int patches = 5;
  int cracks = 10;
  double crack_opacity = 0.6;
  Color crack{0.10f, 0.10f, 0.10f};
};

inline const Color kAsphalt{0.37f, 0.37f, 0.38f};

/// Paints mottling, patches and cracks all over the canvas, whose background is kAsphalt.
void paint_worn_asphalt(Canvas& canvas, const AsphaltWear& wear, Random& random);

}  // namespace hedgehop::scenes::textures
