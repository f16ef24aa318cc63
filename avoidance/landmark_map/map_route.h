#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace hedgehop::avoidance::landmark_map {

/// An obstacle seen from above: the convex hull of points that belong together, north and east, m, counter-clockwise.
using PlanHull = std::vector<Eigen::Vector2d>;

/// Groups points that are within `link_m` of one another, directly or through others, and returns the hull of each
/// group, in the order of the first points. The hull of one or two points consists of these points.
/// @param points_NE  north and east, m. @param link_m  >= 0.
std::vector<PlanHull> plan_hulls(std::span<const Eigen::Vector2d> points_NE, double link_m);

/// Returns the distance from a straight path to a hull, m; 0 if they touch or an end is inside.
double distance_to_hull(const PlanHull& hull, const Eigen::Vector2d& from_NE, const Eigen::Vector2d& to_NE);

/// Returns the shortest path that keeps a clearance from every hull, as its turning points and its end. The turning
/// points are slightly outside the clearance around the corners of a hull. If the path begins or ends nearer to a hull,
/// it may leave or arrive there but not come nearer, and inside a hull not deeper.
/// @param clearance_m  > 0. @return empty if there is no such path.
std::optional<std::vector<Eigen::Vector2d>> path_around(std::span<const PlanHull> hulls, const Eigen::Vector2d& from_NE,
                                                        const Eigen::Vector2d& to_NE, double clearance_m);

}  // namespace hedgehop::avoidance::landmark_map
