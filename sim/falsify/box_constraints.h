#pragma once

#include <string>
#include <vector>

#include "scenes/additions.h"
#include "sim/falsify/falsify_file.h"

namespace hedgehop::sim {

/// Returns the boxes of a search point. @param values  values of the sweep's parameters, in their order.
std::vector<scenes::BoxConfig> boxes_at(const FalsifySearch& search, const std::vector<std::string>& values);

/// Returns by how much boxes violate the constraints of a search; 0 if they satisfy them. The value sums the distances
/// of corners outside the range, the depths of overlaps, and the distance of the nearest box from the straight route,
/// m. If this sum is 0 but no path leads to the goal, it is 1.
double violation(const FalsifySearch& search, const std::vector<scenes::BoxConfig>& boxes);

/// Returns the penetration depth of two boxes in the horizontal plane, m, along the axis of minimum overlap; < 0 if an
/// axis separates them.
/// Source: [GottschalkLinManocha1996] sec. on overlap tests (separating axes), in two dimensions.
double overlap_m(const scenes::BoxConfig& a, const scenes::BoxConfig& b);

/// Returns the area that two boxes share in the horizontal plane, m^2.
/// Source: [SutherlandHodgman1974] sec. on the algorithm: one box, clipped by the four sides of the other.
double common_area_m2(const scenes::BoxConfig& a, const scenes::BoxConfig& b);

/// Returns the horizontal distance of a point to a box, m; 0 inside.
double plan_distance_m(const scenes::BoxConfig& box, const Eigen::Vector2d& p_NE_m);

}  // namespace hedgehop::sim
