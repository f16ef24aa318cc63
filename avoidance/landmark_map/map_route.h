#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace hedgehop::avoidance::landmark_map {

/// An obstacle on the plan: the convex hull of points that belong together, north and east, m, counter-clockwise.
using PlanHull = std::vector<Eigen::Vector2d>;

/// Joins points that lie within `link_m` of one another, directly or through others, and returns the hull of each
/// group, in the order of their first points. A hull of one or two points is those.
/// @param points_NE  north and east, m. @param link_m  >= 0.
std::vector<PlanHull> plan_hulls(std::span<const Eigen::Vector2d> points_NE, double link_m);

/// Distance from a straight way to a hull, m; 0 where they touch or the way begins inside.
double distance_to_hull(const PlanHull& hull, const Eigen::Vector2d& from_NE, const Eigen::Vector2d& to_NE);

/// Returns the shortest way from one place to another that keeps a clearance of every hull, as the places to turn at,
/// the last one included. Turns are taken at points a little outside the clearance round each hull's corners. Where the
/// way begins or ends nearer than that, it may leave or arrive, but not come nearer; inside a hull, nowhere deeper.
/// @param clearance_m  > 0. @return nothing when there is no such way.
std::optional<std::vector<Eigen::Vector2d>> way_round(std::span<const PlanHull> hulls, const Eigen::Vector2d& from_NE,
                                                      const Eigen::Vector2d& to_NE, double clearance_m);

}  // namespace hedgehop::avoidance::landmark_map
