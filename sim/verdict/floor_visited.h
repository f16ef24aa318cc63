#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "scenes/scene.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// Returns the share of the square cells of a plan whose centers a disc covers while it moves along a path, 0..1.
/// @param plan_NE_m  north, east extent. Cells start at its south-west corner; those cut by the other edges count too.
/// @param cell_m     side of a cell, m, > 0; see require_floor_cells().
/// @param path_NE_m  positions, dense enough to represent the curve.
double visited_share(const Eigen::AlignedBox2d& plan_NE_m, double cell_m, const std::vector<Eigen::Vector2d>& path_NE_m,
                     double disc_radius_m);

/// Throws InputError with the key of each check `floor_visited` that divides the plan of the scene into more than 10
/// million cells.
void require_floor_cells(const Scenario& scenario, const scenes::Scene& scene);

}  // namespace hedgehop::sim
