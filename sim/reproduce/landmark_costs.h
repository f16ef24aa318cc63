#pragma once

#include "sim/reproduce/calculations.h"

namespace hedgehop::sim {

/// Measures the filter time per image for several numbers of landmarks: `landmarks` (8 to 1,000), `image_ms` (median
/// over images, wall time), `speed` (at 10 Hz, as a multiple of real time), and `growth_8_to_35`, equal in every row.
/// The lateral flight of [Shah2009] ch. 4 past random corners, all of them in the image. Source: [Shah2009] ch. 6, sec.
/// on computational effort.
Columns landmark_costs();

}  // namespace hedgehop::sim
