#pragma once

#include <string>
#include <vector>

#include "scenes/additions.h"
#include "sim/falsify/falsify_file.h"

namespace hedgehop::sim {

/// The boxes of a point of a search. @param values  of the sweep's parameters, in their order.
std::vector<scenes::BoxConfig> boxes_at(const FalsifySearch& search, const std::vector<std::string>& values);

/// By how much boxes break a search's constraints; 0 where they keep them: m that corners lie outside and boxes lie in
/// each other, 1 where no way leads to the goal.
double violation(const FalsifySearch& search, const std::vector<scenes::BoxConfig>& boxes);

/// How far two boxes lie in each other in the plan, m, along the direction that parts them soonest; < 0 where they are
/// apart along one. Source: [GottschalkLinManocha1996] sec. on overlap tests (separating axes), in two dimensions.
double overlap_m(const scenes::BoxConfig& a, const scenes::BoxConfig& b);

/// Distance of a point of the plan to a box, m; 0 inside.
double plan_distance_m(const scenes::BoxConfig& box, const Eigen::Vector2d& p_NE_m);

}  // namespace hedgehop::sim
