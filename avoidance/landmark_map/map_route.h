#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace hedgehop::avoidance::landmark_map {

/// An obstacle seen from above: the convex hull of points that belong together, north and east, m, counter-clockwise.
using PlanHull = std::vector<Eigen::Vector2d>;

/// Joins points that lie within `link_m` of one another, directly or through others, and returns the hull of each
/// group, in the order of their first points. A hull of one or two points is those.
/// @param points_NE  north and east, m. @param link_m  >= 0.
std::vector<PlanHull> plan_hulls(std::span<const Eigen::Vector2d> points_NE, double link_m);

/// Distance from a straight path to a hull, m; 0 where they touch or an end lies inside.
double distance_to_hull(const PlanHull& hull, const Eigen::Vector2d& from_NE, const Eigen::Vector2d& to_NE);

/// Returns the shortest path that keeps a clearance of every hull, as the points to turn at, its end included. Turns
/// are taken a little outside the clearance around each hull's corners. Where the path begins or ends nearer to a hull,
/// it may leave or arrive, but not come nearer; inside a hull, nowhere deeper.
/// @param clearance_m  > 0. @return nothing when there is no such path.
std::optional<std::vector<Eigen::Vector2d>> path_around(std::span<const PlanHull> hulls, const Eigen::Vector2d& from_NE,
                                                        const Eigen::Vector2d& to_NE, double clearance_m);

}  // namespace hedgehop::avoidance::landmark_map
