#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "avoidance/local_map/hull_clearance.h"
#include "avoidance/local_map/level_slice.h"
#include "avoidance/local_map/stop_planner.h"

namespace hedgehop::avoidance::local_map {

/// Returns whether a position is within the slice and unknown.
bool is_unknown(const LevelSlice& slice, const Eigen::Vector2d& p_W);

/// Returns the unknown cell nearest to the first violation of the distance from unknown space by a path that ignores
/// it. Empty if there is no violation. @param reach_m  search radius: required distance from unknown space, with the
/// hull.
std::optional<Eigen::Vector2d> unknown_on_path(const LevelSlice& slice, const HullClearance& hull_clearance,
                                               const std::vector<PathState>& path, double reach_m);

/// Returns whether the nose points at a position, within 20 degrees. @param heading_rad  of the nose, from north to
/// east.
bool points_at(const Eigen::Vector2d& place_W, const Eigen::Vector2d& p_W, double heading_rad);

/// Measures the duration of a condition.
class ConditionTimer {
 public:
  /// @param t_s  current time, increasing from call to call. @return duration, s; empty if the condition is false.
  std::optional<double> update(bool holds, double t_s) {
    if (!holds) {
      since_s_.reset();
      return {};
    }
    if (!since_s_) since_s_ = t_s;
    return t_s - *since_s_;
  }
  void reset() { since_s_.reset(); }

 private:
  std::optional<double> since_s_;
};

/// Measures the time since the route to the goal last became shorter.
class ProgressTimer {
 public:
  /// @param route_m  length of the route to the goal, if there is one. @param t_s  current time, increasing from call
  /// to call.
  /// @return s; 0 before the first route.
  double stalled_s(std::optional<double> route_m, double t_s);
  void reset() { from_m_.reset(); }

 private:
  std::optional<double> from_m_;
  double since_s_ = 0.0;
};

/// The unknown position that prevents a better stop. The vehicle turns its nose towards it.
class UnknownTarget {
 public:
  /// North and east, m.
  const std::optional<Eigen::Vector2d>& place_W() const { return place_W_; }
  /// Whether the vehicle has hovered in front of the position and keeps away until it is observed or closed.
  bool backs_off() const { return backs_off_; }

  /// @param held  whether a plan that ignores unknown space would stop at a better position: the end of `hoped`.
  /// @param reach_m  required distance from unknown space, with the hull. @param heading_rad  of the nose, from north
  /// to east.
  void update(bool held, const std::vector<PathState>& hoped, const LevelSlice& slice,
              const HullClearance& hull_clearance, double reach_m, const PathState& now, double heading_rad);

  /// Returns the time for which the vehicle has hovered and pointed at the position, s; empty if it does not. @param
  /// v_cmd_W  current command, m/s. @param heading_rad  of the nose, from north to east.
  std::optional<double> inspected_s(const PathState& now, const Eigen::Vector2d& v_cmd_W, double heading_rad);
  void restart_timer() { inspection_.reset(); }

 private:
  std::optional<Eigen::Vector2d> place_W_;
  bool backs_off_ = false;
  ConditionTimer inspection_;
};

/// Returns whether a velocity, m/s, is negligible: below 0.3 m/s.
bool is_hovering(const Eigen::Vector2d& v_W);

}  // namespace hedgehop::avoidance::local_map
