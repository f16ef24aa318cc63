#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>

namespace hedgehop::sim {

/// Returns a distance in m by which a point of the plan (north, east; m) can move in any direction and remain free;
/// <= 0 if it is not free.
using PlanClearance = std::function<double(const Eigen::Vector2d& p_NE_m)>;

/// A circle of a horizontal plan.
struct GoalCircle {
  Eigen::Vector2d center_NE_m = Eigen::Vector2d::Zero();
  double radius_m = 0.0;
};

/// Returns the length of the shortest free path from a point to a circle of a horizontal plan, m; 0 inside the circle,
/// nullopt if the start is not free or there is no path. The path is found by Theta* on a square grid and then pulled
/// tight, so every segment is free: the length is never below the shortest one, and at most 2 % above it if the free
/// gaps on the shortest path are wider than a cell. @param bounds_NE_m  of the grid, not empty.
/// @param cell_m  > 0. Source: [NashDanielKoenigFelner2007] sec. on basic Theta*.
std::optional<double> shortest_path_m(const Eigen::Vector2d& start_NE_m, const GoalCircle& goal,
                                      const Eigen::AlignedBox2d& bounds_NE_m, double cell_m,
                                      const PlanClearance& clearance_m);

}  // namespace hedgehop::sim
