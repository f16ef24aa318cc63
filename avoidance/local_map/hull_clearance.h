#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "avoidance/local_map/level_slice.h"
#include "avoidance/local_map/stop_planner.h"
#include "avoidance/module.h"

namespace hedgehop::avoidance::local_map {

/// Horizontal discs that together contain the hull. One disc is sufficient for a multicopter. The tail boom of a
/// helicopter is longer than the rotor and sweeps an area when it turns.
class HullDiscs {
 public:
  struct Disc {
    Eigen::Vector2d p_H;  ///< center, m: x along the heading, y to the right
    double radius_m;      ///< > 0
  };

  HullDiscs() = default;
  /// Makes one disc per box and several along an elongated box. If a corner of a box is outside the cylinder that
  /// contains the vehicle, the box contains a rotor and its inscribed disc is used. If discs save little space or there
  /// are no boxes, the result is that cylinder.
  explicit HullDiscs(const VehicleLimits& limits);

  const std::vector<Disc>& discs() const { return discs_; }

 private:
  std::vector<Disc> discs_;
};

/// Returns the positions of the discs, from B, while the vehicle turns from one heading to another along the shorter
/// arc.
/// @return offsets in W, discs of all headings on the way. No point of the hull moves farther than `step_m` between two
/// of them.
std::vector<HullDiscs::Disc> sweep(const HullDiscs& hull_discs, double from_rad, double to_rad, double step_m);

/// Checks the clearance of the hull along a path, including a simultaneous turn.
class HullClearance {
 public:
  HullClearance() = default;
  /// @param step_m  maximum motion of a disc between two tested headings.
  HullClearance(HullDiscs hull_discs, const Clearance& clearance, double step_m)
      : hull_discs_(std::move(hull_discs)), clearance_(clearance), step_m_(step_m) {}

  /// Sets the required clearance.
  void set_clearance(const Clearance& clearance) { clearance_ = clearance; }
  /// Sets the headings of a turn along the shorter arc. The progress of the turn along the path is unknown, so every
  /// state of the path is tested with all of them.
  void set_turn(double from_rad, double to_rad) { swept_ = sweep(hull_discs_, from_rad, to_rad, step_m_); }
  /// Sets a margin that is also kept from unknown space, because an obstacle may begin there. Images show this margin
  /// around positions beyond the distance at which the view is wide enough. Nearer positions keep the current distance
  /// from unknown space, if it is less. Requires set_turn().
  /// @param p_W  position of the vehicle. @param margin_m  around the hull, >= 0; 0: the hull itself is sufficient.
  /// @param half_view_rad  angle from the center of the images to their sides, > 0.
  void keep_from_unknown(const LevelSlice& slice, const Eigen::Vector2d& p_W, double margin_m, double half_view_rad);

  /// Returns the missing distance of a state from obstacles and, if requested, from unknown space.
  ClearanceDeficit deficit(const LevelSlice& slice, const PathState& state, bool unknown_too) const;

  /// Returns the heading up to which the vehicle may turn at any position of the path without violating a clearance, or
  /// violating it more than now. @return a heading on the shorter arc between both, rad.
  double free_turn_rad(const LevelSlice& slice, const std::vector<PathState>& path, double from_rad,
                       double to_rad) const;

 private:
  HullDiscs hull_discs_;
  Clearance clearance_;
  double step_m_ = 0.3;
  std::vector<HullDiscs::Disc> swept_;
  struct UnknownMargin {
    Eigen::Vector2d from_W = Eigen::Vector2d::Zero();  ///< position of the vehicle
    double beyond_m = 0.0, near_m = 0.0, far_m = 0.0;  ///< far_m is kept beyond a distance from it, else near_m
  } unknown_margin_;
};

}  // namespace hedgehop::avoidance::local_map
