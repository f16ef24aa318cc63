#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace hedgehop::sim {

/// Returns the rows to draw of series with a common time axis. The rows are divided into equal intervals. Each interval
/// keeps the rows of the minimum and maximum of each series and the first row that is not finite. The first and the
/// last row are kept, too. All extremes remain.
/// @param series  of equal length. @param max_points  >= 2; all rows are kept if there are no more.
/// @return row numbers in increasing order, at most max(max_points, 3 * number of series + 2) of them.
std::vector<size_t> decimate(std::span<const std::vector<double>> series, size_t max_points);

/// Returns a subset of the points of a line, including its ends. All other points are at most `tolerance_m` away from
/// the new line. The tolerance is doubled until at most `max_points` remain. Distances are relative to the first point
/// and rounded to float.
/// @param line_NE_m  open, in order. @param tolerance_m  > 0. @param max_points  >= 2.
/// Source: after [DouglasPeucker1973], implemented by OpenCV.
std::vector<Eigen::Vector2d> simplified(const std::vector<Eigen::Vector2d>& line_NE_m, double tolerance_m,
                                        size_t max_points);

}  // namespace hedgehop::sim
