#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sim/batch/statistics.h"

/// Variance-based sensitivity of a figure to the parameters of a sweep.
namespace hedgehop::sim {

/// Sobol indices of one parameter: shares of the variance of the figure.
struct SobolIndex {
  double first = 0.0;  ///< share of the parameter alone
  double total = 0.0;  ///< share of the parameter and of its interactions; total - first is that of the interactions
  Interval first_interval, total_interval;  ///< 95 %; equal to the value if this is exact
};

/// Returns the Sobol indices of all parameters from a Sobol design with indices; empty if the figure is constant.
/// @param figures  of the points in the order of the design: for each block A, B, and A with one column of B for each
/// parameter. All finite. The intervals are percentiles of 500 bootstrap samples of the blocks.
/// Source: [Saltelli2010] table 2, (b) for the first-order and (f), after [Jansen1999], for the total index. Differs:
/// the mean is subtracted first, which reduces the error of (b).
std::vector<SobolIndex> sobol_indices(std::span<const double> figures, size_t parameters);

/// Returns the Sobol indices of all parameters from a full grid, with equal weights of its points; empty if the figure
/// is constant. The values are exact for the grid. Source: [Saltelli2010] sec. 2, from the definition.
/// @param figures  of the points, the last parameter changing fastest. All finite. @param counts  values per parameter.
std::vector<SobolIndex> grid_indices(std::span<const double> figures, const std::vector<size_t>& counts);

}  // namespace hedgehop::sim
