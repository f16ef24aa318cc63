#pragma once

#include <functional>
#include <vector>

#include "scenes/mesh/bodies.h"

namespace hedgehop::scenes::mesh {

/// Adds the ground at z = 0 as panels on a grid of lines that crosses the whole plane, out to 12 km and more, in a
/// chunk of its own. Images are laid out from W's origin.
/// @param norths_m, easts_m  lines that the grid must have, in order; at least two of each, on both sides of 0.
/// @param cover_at  the image of a cell, by the middle of the cell in the plan (north, east), m.
void add_ground(std::vector<double> norths_m, std::vector<double> easts_m,
                const std::function<Cover(const Eigen::Vector2d& middle_NE)>& cover_at, MeshBuilder& mesh);

/// Adds ground of one kind; the grid is fine within `half_m` of the origin.
void add_ground(double half_m, const Cover& cover, MeshBuilder& mesh);

}  // namespace hedgehop::scenes::mesh
