#pragma once

#include "sim/reproduce/calculations.h"

namespace hedgehop::sim {

/// Measures a choice among 3 x 3 to 27 x 27 sections of a 1280 x 720 depth map: `sections` in total, `decisions_hz`,
/// `cost_ms` (medians, wall time) and `cost_over_3x3`, measured alternately. Source: [Perez2018] table 1.
Columns section_costs();

}  // namespace hedgehop::sim
