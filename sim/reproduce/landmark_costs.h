#pragma once

#include "sim/reproduce/calculations.h"

namespace hedgehop::sim {

/// What an image costs the filter, by the number of landmarks: `landmarks` (8 to 1,000), `image_ms` (median over
/// images, wall time), `speed` (of 10 images a second, as a multiple of real time), and `growth_8_to_35`, the same
/// in every row. The lateral flight of [Shah2009] ch. 4 past random corners, all of them in the image. Source:
/// [Shah2009] ch. 6, sec. on computational effort.
Columns landmark_costs();

}  // namespace hedgehop::sim
