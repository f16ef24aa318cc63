#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>

namespace hedgehop::sim {

/// Returns the length of the shortest free path between two points of a horizontal plan, m, by Theta* on a square grid.
/// Corners of the path are grid points, so each adds up to about one cell. nullopt if an end is not free or there is no
/// path. @param is_free  whether a point (north, east; m) is free. @param bounds_NE_m  of the grid, not empty.
/// @param cell_m  > 0. Source: [NashDanielKoenigFelner2007] sec. on basic Theta*.
std::optional<double> shortest_path_m(const Eigen::Vector2d& start_NE_m, const Eigen::Vector2d& goal_NE_m,
                                      const Eigen::AlignedBox2d& bounds_NE_m, double cell_m,
                                      const std::function<bool(const Eigen::Vector2d& p_NE_m)>& is_free);

}  // namespace hedgehop::sim
