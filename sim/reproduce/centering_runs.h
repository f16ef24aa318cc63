#pragma once

#include "sim/reproduce/calculations.h"

namespace hedgehop::sim {

/// A point mass in a straight corridor of 4 m, 1.5 m left of its middle at first, with the printed controller: `x_m`
/// along the corridor and `off_middle_m` to the right of its middle, twice a second for two minutes; `settled_m`, the
/// distance after which it stays within 0.2 m of the middle, the same in every row. The signal is exact. Source:
/// [Zingg2010] fig. 11. Differs: the speed, which is not printed, is 0.42 m/s.
Columns centering_exact();

/// The same with normal errors of the signal that match the mean and greatest error of [Zingg2010] fig. 9; seed 1.
/// Source: [Zingg2010] fig. 12.
Columns centering_noisy();

}  // namespace hedgehop::sim
