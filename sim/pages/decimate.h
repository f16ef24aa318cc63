#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace hedgehop::sim {

/// Picks the rows to draw of series that share a time axis: in each of equal stretches of rows, those where a series
/// is smallest and largest and the first gap (not finite), and the first and last row of all. No extreme is lost.
/// @param series  of equal length. @param max_points  >= 2; all rows are kept when there are no more.
/// @return rising row numbers, at most max(max_points, 3 * number of series + 2) of them.
std::vector<size_t> decimate(std::span<const std::vector<double>> series, size_t max_points);

/// Picks points of a line so that no other lies farther than `tolerance_m` from the line through those; its ends stay.
/// The tolerance is doubled until `max_points` are enough. Precise to a float's rounding of the distance from the first
/// point.
/// @param line_NE_m  open, in order. @param tolerance_m  > 0. @param max_points  >= 2.
/// Source: after [DouglasPeucker1973], as OpenCV does it.
std::vector<Eigen::Vector2d> simplified(const std::vector<Eigen::Vector2d>& line_NE_m, double tolerance_m,
                                        size_t max_points);

}  // namespace hedgehop::sim
