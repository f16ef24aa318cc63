#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <limits>

#include "avoidance/local_map/level_slice.h"
#include "avoidance/local_map/route_field.h"
#include "avoidance/local_map/stop_planner.h"

namespace hedgehop::avoidance::local_map {

/// A margin that is larger than a voxel is kept wherever a way of that width is known. Smaller ones are below the
/// resolution of the map: they are reduced in every narrow passage. Plans add the errors of the map to a margin that is
/// kept, and routes prefer detours to narrower passages.
class KeptMargin {
 public:
  KeptMargin() = default;
  /// @param margin_m  as configured. @param voxel_m  of the map.
  KeptMargin(double margin_m, double voxel_m)
      : is_kept_(margin_m > voxel_m),
        margin_m_(margin_m),
        planned_m_(margin_m + (is_kept_ ? kMapErrorVoxels * voxel_m : 0.0)),
        passing_m_(margin_m + (is_kept_ ? kPassingVoxels * voxel_m : 0.0)) {}

  bool is_kept() const { return is_kept_; }
  /// Returns the margin of plans, m.
  double planned_m() const { return planned_m_; }
  /// Returns the margin of routes and at walking pace, m.
  double passing_m() const { return passing_m_; }

  /// Returns the margin from unknown space, m: 0 in narrow passages, and if the margin is not kept.
  double from_unknown_m() const { return is_kept_ && !is_narrow_ ? planned_m_ : 0.0; }

  /// Returns the clearance at walking pace. A margin that is not kept is the minimum. One that is kept does not grow
  /// with the speed. If the route leads closer to obstacles than the vehicle is now, no way with the margin is known;
  /// then it is that of the route.
  /// @param full  clearance with the planned margin. @param nearest_m  minimum distance of the route from obstacles.
  Clearance walking(const Clearance& full, const RouteClearance& route_clearance, const LevelSlice& slice,
                    const Eigen::Vector2d& p_W, double nearest_m) {
    Clearance clearance = full;
    if (!is_kept_) {
      clearance.margin_m = route_clearance.least_m - full.hull_m;
      return clearance;
    }
    const double error_m = 0.5 * slice.cell_m();
    const bool comes_closer = nearest_m < slice.to_occupied_m(p_W) - error_m;
    is_narrow_ = nearest_m < route_clearance.preferred_m && (is_narrow_ || comes_closer);
    clearance.margin_s = 0.0;
    clearance.margin_m = passing_m_;
    if (is_narrow_) clearance.margin_m = std::max(nearest_m - error_m, route_clearance.least_m) - clearance.hull_m;
    return clearance;
  }
  /// Ends a narrow passage.
  void widen() {
    if (is_narrow_) nearest_to_goal_m_ = kNever;
    is_narrow_ = false;
  }
  /// Returns which detours are better than a narrow passage. If the vehicle has not come nearer to the goal for
  /// kPatienceS, only short ones, until it has passed a narrow passage.
  /// @param goal_W  of the mission. @param t_s  increasing from call to call.
  RouteClearance::Detours detours(const Eigen::Vector2d& p_W, const Eigen::Vector2d& goal_W, double t_s) {
    constexpr double kNearerM = 0.5, kPatienceS = 45.0;
    const double to_goal_m = (goal_W - p_W).norm();
    if ((goal_W - goal_W_).norm() > kNearerM) nearest_to_goal_m_ = kNever;
    goal_W_ = goal_W;
    const bool gives_up = nearest_to_goal_m_ < kNever && t_s > nearest_at_s_ + kPatienceS;
    if (!gives_up && to_goal_m < nearest_to_goal_m_ - kNearerM) {
      nearest_to_goal_m_ = to_goal_m;
      nearest_at_s_ = t_s;
    }
    return !is_kept_  ? RouteClearance::Detours::usual
           : gives_up ? RouteClearance::Detours::short_ones
                      : RouteClearance::Detours::long_ones;
  }
  bool is_narrow() const { return is_narrow_; }

  /// Returns whether the vehicle is closer than a margin that is to be kept, although it passes no narrow passage: the
  /// obstacle was seen late, or the stop before it takes longer. @param margin_m  distance from the hull to occupied
  /// cells.
  bool is_missed(double margin_m) const { return is_kept_ && !is_narrow_ && margin_m < margin_m_; }

  /// Counts a decision. @param margin_m  distance from the hull to occupied cells.
  void count(double margin_m) {
    narrows_ += is_narrow_;
    misses_ += is_missed(margin_m);
    least_m_ = std::min(least_m_, margin_m);
  }
  int64_t missed_decisions() const { return misses_; }
  int64_t narrow_decisions() const { return narrows_; }
  double least_m() const { return least_m_; }  ///< infinite before the first decision

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  static constexpr double kMapErrorVoxels = 1.5;  // half for a look-up of the distance, one for the map and its drift
  static constexpr double kPassingVoxels = 1.0;   // at walking pace: half for a look-up, half for the map

  bool is_kept_ = false, is_narrow_ = false;
  double margin_m_ = 0.0, planned_m_ = 0.0, passing_m_ = 0.0;
  Eigen::Vector2d goal_W_ = Eigen::Vector2d::Zero();
  double nearest_to_goal_m_ = kNever, nearest_at_s_ = 0.0;  ///< since the last goal or narrow passage
  int64_t narrows_ = 0, misses_ = 0;
  double least_m_ = kNever;
};

}  // namespace hedgehop::avoidance::local_map
