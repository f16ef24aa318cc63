#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>

#include "avoidance/stereo_corridor/corridor_search.h"

/// Flight to a goal, an addition of the modified law. The paper leaves this to a route planner.
namespace hedgehop::avoidance::stereo_corridor {

/// The law of CorridorSearch::join() with priority for the goal: the direction of the goal is tried before the
/// direction of flight, so that the vehicle returns to its course. If the goal is above or below the view, the vehicle
/// flies towards the image edge. If the goal is to the side, the vehicle flies along the free corridor nearest to its
/// direction, to bring the goal into view.
/// @param p_CG_C  the goal. @param v_WB_C  velocity, m/s. @param followed  current pixel of the last target, if known.
std::optional<Target> choose_goal_first(CorridorSearch& search, const Eigen::Vector3d& p_CG_C,
                                        const Eigen::Vector3d& v_WB_C, const std::optional<cv::Point>& followed);

/// Returns the speed towards a goal, m/s, at most `cruise_mps`. At this speed the diameter of the turning circle is at
/// most the distance to the goal; otherwise the vehicle would circle a missed goal without end.
/// @param distance_m  horizontal distance to the goal, >= 0. @param acceleration_mps2  maximum acceleration, > 0.
double approach_speed_mps(double cruise_mps, double distance_m, double acceleration_mps2);

/// Decides when a vehicle that sees only ahead turns on the spot towards a goal that it has passed. Not in the paper.
/// The turn begins when the goal recedes and is at least 1 m behind, and ends when the goal is ahead. Every turn
/// doubles this distance and makes it at least 3 m longer than the distance by which the vehicle has just passed the
/// goal. So a long detour is still flown, and the next turn happens at another position. The distance is reset when the
/// goal is closer than ever before.
/// If no corridor towards the goal is free, the vehicle continues to turn: first towards the part ahead that it has not
/// seen yet, the next time towards the direction from which it came, and so on.
class TurnBack {
 public:
  /// @param p_CG_C  the goal, from the camera, m. @param p_WB  estimated position of the vehicle, m.
  /// @return whether to turn on the spot towards the goal.
  bool update(const Eigen::Vector3d& p_CG_C, const Eigen::Vector3d& p_WB);

  /// Returns the side to turn to, 1 for right and -1 for left. During a turn it is the side of the goal. After a turn,
  /// near the same position, it is the side to try next. Otherwise empty.
  std::optional<double> side() const { return side_; }

 private:
  static constexpr double kMayPassM = 1.0;
  double may_pass_m_ = kMayPassM;
  double nearest_m_ = std::numeric_limits<double>::infinity();  ///< minimum distance to the goal since the last turn
  double nearest_ever_m_ = std::numeric_limits<double>::infinity();
  bool turning_ = false;
  std::optional<double> side_;                            ///< 1 or -1
  bool tries_ahead_ = true;                               ///< after the next turn
  Eigen::Vector3d p_turned_W_ = Eigen::Vector3d::Zero();  ///< position at the end of the last turn, m
};

}  // namespace hedgehop::avoidance::stereo_corridor
