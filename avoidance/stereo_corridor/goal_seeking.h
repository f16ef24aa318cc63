#pragma once

#include <Eigen/Core>
#include <limits>
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

/// Decides when a vehicle that sees ahead only turns on the spot towards a goal that it has passed: as soon as the goal
/// recedes and lies a meter behind, and until it lies ahead. Every turn doubles that meter, and makes it at least 3 m
/// more than where the vehicle then stood, so that a long detour is still flown and the next look is from elsewhere,
/// until the goal has been closer than ever. Where nothing is free towards the goal, the vehicle turns on: first to the
/// way ahead that it had not seen yet, the next time to the way that it came, and so on, as one searches a wall for a
/// door. Ours.
class TurnBack {
 public:
  /// @param p_CG_C  the goal, from the camera, m. @param p_WB  the vehicle as estimated, m.
  /// @return whether to turn towards the goal on the spot now.
  bool update(const Eigen::Vector3d& p_CG_C, const Eigen::Vector3d& p_WB);

  /// Returns the side to turn to, 1 to the right and -1 to the left: the goal's while it turns, then, where it stands,
  /// that of the way to try. None elsewhere.
  std::optional<double> side() const { return side_; }

 private:
  static constexpr double kMayPassM = 1.0;
  double may_pass_m_ = kMayPassM;
  double nearest_m_ = std::numeric_limits<double>::infinity();  ///< to the goal, since the last turn
  double nearest_ever_m_ = std::numeric_limits<double>::infinity();
  bool turning_ = false;
  std::optional<double> side_;                            ///< 1 or -1
  bool tries_ahead_ = true;                               ///< after the next turn
  Eigen::Vector3d p_turned_W_ = Eigen::Vector3d::Zero();  ///< where the last turn ended, m
};

}  // namespace hedgehop::avoidance::stereo_corridor
