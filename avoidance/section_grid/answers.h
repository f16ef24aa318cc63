#pragma once

#include <Eigen/Core>

#include "avoidance/section_grid/section_grid.h"

namespace hedgehop::avoidance::section_grid {

/// Direction in B, of length 1, of the position that an answer goes to.
/// @param ray_B  direction of the chosen section, of length 1. @param side  -1 to give way to the left, 1 to the right.
/// @param recedes  whether a sidestep also goes back, as before something that follows.
/// Ours, after the trade study that [Perez2018] sec. VII proposes.
Eigen::Vector3d direction_B(Answer answer, const Eigen::Vector3d& ray_B, double side, bool recedes);

/// Whether the vehicle faces the positions that an answer goes to.
bool faces_path(Answer answer);

}  // namespace hedgehop::avoidance::section_grid
