#pragma once

#include <vector>

#include "vision/corridor/corridor_flow.h"

namespace hedgehop::vision::corridor {

/// Returns the direction of a corridor's walls, rad to the right of the heading, within `most_rad`: the one across
/// which the accepted points of each side scatter least about their median. 0 where a side has fewer than `least`.
/// Without this correction a heading oblique to the walls shifts the middle: points ahead lie nearer on one side and
/// farther on the other.
double wall_direction_rad(const std::vector<WallPoint>& points, double most_rad, int least);

/// Returns the points in frame H rotated to a direction, rad to the right of the heading.
std::vector<WallPoint> rotate_points(std::vector<WallPoint> points, double direction_rad);

}  // namespace hedgehop::vision::corridor
