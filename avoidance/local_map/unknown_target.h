#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "avoidance/local_map/hull_clearance.h"
#include "avoidance/local_map/level_slice.h"
#include "avoidance/local_map/stop_planner.h"

namespace hedgehop::avoidance::local_map {

/// Whether a place is within the slice, and unknown.
bool is_unknown(const LevelSlice& slice, const Eigen::Vector2d& p_W);

/// The unknown cell nearest to where a path that ignores the unknown first comes too near to one; nothing where it
/// never does. @param hull_m  radius of the vehicle: how far around that place is searched.
std::optional<Eigen::Vector2d> unknown_on_path(const LevelSlice& slice, const HullClearance& hull_clearance,
                                               const std::vector<PathState>& path, double hull_m);

/// Whether the nose points at a place, within 20 degrees. @param heading_rad  of the nose, from north to east.
bool points_at(const Eigen::Vector2d& place_W, const Eigen::Vector2d& p_W, double heading_rad);

/// For how long something has been so.
class ConditionTimer {
 public:
  /// @param t_s  now, rising from call to call. @return s, 0 from the first time on; nothing where it does not hold.
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

/// For how long the way to the goal has stayed as long as it is.
class ProgressTimer {
 public:
  /// @param route_m  to the goal, where there is a way. @param t_s  now, rising from call to call. @return s; 0 until
  /// there was a way.
  double stalled_s(std::optional<double> route_m, double t_s);
  void reset() { from_m_.reset(); }

 private:
  std::optional<double> from_m_;
  double since_s_ = 0.0;
};

/// The unknown place that keeps the vehicle from a better stop, if one does, and to which its nose therefore turns.
class UnknownTarget {
 public:
  /// North and east, m.
  const std::optional<Eigen::Vector2d>& place_W() const { return place_W_; }
  /// Has stood before the place, and keeps away until it is seen or closed.
  bool backs_off() const { return backs_off_; }

  /// @param held  a plan that ignored the unknown would stop at a better place: at the end of `hoped`.
  /// @param hull_m  radius of the vehicle. @param heading_rad  of the nose, from north to east.
  void update(bool held, const std::vector<PathState>& hoped, const LevelSlice& slice,
              const HullClearance& hull_clearance, double hull_m, const PathState& now, double heading_rad);

  /// For how long the vehicle has stood and looked at the place, s; nothing where it does not. @param v_cmd_W  what is
  /// commanded now, m/s. @param heading_rad  of the nose, from north to east.
  std::optional<double> inspected_s(const PathState& now, const Eigen::Vector2d& v_cmd_W, double heading_rad);
  void restart_timer() { inspection_.reset(); }

 private:
  std::optional<Eigen::Vector2d> place_W_;
  bool backs_off_ = false;
  ConditionTimer inspection_;
};

/// Whether a velocity, m/s, is as good as none: below 0.3 m/s.
bool is_hovering(const Eigen::Vector2d& v_W);

}  // namespace hedgehop::avoidance::local_map
