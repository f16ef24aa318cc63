#pragma once

#include "sim/reproduce/calculations.h"

namespace hedgehop::sim {

/// Simulates a point mass in a straight corridor of 4 m with the published controller and an exact signal. It starts
/// 1.5 m left of the middle. Columns: `x_m` along the corridor and `off_middle_m` to the right of its middle, every 0.5
/// s for two minutes; `settled_m`, the distance after which it remains within 0.2 m of the middle, equal in every row.
/// Source: [Zingg2010] fig. 11. Differs: the speed, which is not published, is 0.42 m/s.
Columns centering_exact();

/// The same with normal signal errors that match the mean and maximum error of [Zingg2010] fig. 9; seed 1.
/// Source: [Zingg2010] fig. 12.
Columns centering_noisy();

}  // namespace hedgehop::sim
