#include "scenes/textures/asphalt.h"

namespace hedgehop::scenes::textures {

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
