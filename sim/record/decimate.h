#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hedgehop::sim {

/// Picks the rows to draw of series that share a time axis: in each of equal stretches of rows, those where a series
/// is smallest and largest and the first gap (not finite), and the first and last row of all. No extreme is lost.
/// @param series  of equal length. @param max_points  >= 2; all rows are kept when there are no more.
/// @return rising row numbers, at most max(max_points, 3 * number of series + 2) of them.
std::vector<size_t> decimate(std::span<const std::vector<double>> series, size_t max_points);

}  // namespace hedgehop::sim
