#pragma once

#include <vector>

#include "vision/corridor/corridor_flow.h"

namespace hedgehop::vision::corridor {

/// Returns the direction of a corridor's walls, rad to the right of the heading, within `most_rad`: the one across
/// which the good points of each side scatter least about their median. 0 where there are fewer than `least` on either
/// side. Without it a nose turned aside shifts the middle, as points ahead lie nearer on one side and farther on the
/// other.
double wall_direction_rad(const std::vector<WallPoint>& points, double most_rad, int least);

/// Returns the points as seen by one who looks along a direction, rad to the right of the heading.
std::vector<WallPoint> rotate_points(std::vector<WallPoint> points, double direction_rad);

}  // namespace hedgehop::vision::corridor
