#pragma once

#include <Eigen/Core>
#include <optional>

#include "avoidance/stereo_corridor/corridor_search.h"

/// What the paper leaves to a route planner: how to come to a goal. Ours.
namespace hedgehop::avoidance::stereo_corridor {

/// The law of CorridorSearch::join() with the goal before everything: its direction is tried before the direction of
/// flight, so that the vehicle returns to its course. A goal above or below the view is approached at the image's edge;
/// while it lies aside, the free corridor nearest to its direction is flown, so that it comes into view.
/// @param p_CG_C  the goal. @param v_WB_C  velocity, m/s. @param followed  where the last target is now, if known.
std::optional<Target> choose_goal_first(CorridorSearch& search, const Eigen::Vector3d& p_CG_C,
                                        const Eigen::Vector3d& v_WB_C, const std::optional<cv::Point>& followed);

/// Returns the speed towards a goal, m/s, at most `cruise_mps`: so slow that the circle it can turn in is no wider than
/// the distance of the goal, else a missed goal would be circled for ever.
/// @param distance_m  to the goal in the plan, >= 0. @param acceleration_mps2  that the vehicle is allowed, > 0.
double approach_speed_mps(double cruise_mps, double distance_m, double acceleration_mps2);

}  // namespace hedgehop::avoidance::stereo_corridor
