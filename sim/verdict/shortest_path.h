#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>

namespace hedgehop::sim {

/// Length of the shortest free path between two points of a level plan, m, by Theta* on a square grid: its corners lie
/// at the grid's points, so it is too long by up to about a cell at each. None where an end is not free or nothing
/// leads from one to the other. @param is_free  of a point (north, east), m. @param bounds_NE_m  of the grid, not
/// empty.
/// @param cell_m  > 0. Source: [NashDanielKoenigFelner2007] sec. on basic Theta*.
std::optional<double> shortest_path_m(const Eigen::Vector2d& start_NE_m, const Eigen::Vector2d& goal_NE_m,
                                      const Eigen::AlignedBox2d& bounds_NE_m, double cell_m,
                                      const std::function<bool(const Eigen::Vector2d& p_NE_m)>& is_free);

}  // namespace hedgehop::sim
