#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "avoidance/local_map/level_slice.h"
#include "avoidance/local_map/stop_planner.h"
#include "avoidance/module.h"

namespace hedgehop::avoidance::local_map {

/// The vehicle's hull_discs in the plan, level, as discs that together hold it. Of a multicopter one is enough; a
/// helicopter's tail boom, longer than its rotor, swings about as it turns.
class HullDiscs {
 public:
  struct Disc {
    Eigen::Vector2d p_H;  ///< middle, m: x along the heading, y to the right
    double radius_m;      ///< > 0
  };

  HullDiscs() = default;
  /// One disc for each box, several along a long one. A box whose corner lies beyond the cylinder that holds the
  /// vehicle holds a rotor: the disc in it counts. Where discs save little, or no boxes are given, that cylinder is the
  /// hull_discs.
  explicit HullDiscs(const VehicleLimits& limits);

  const std::vector<Disc>& discs() const { return discs_; }

 private:
  std::vector<Disc> discs_;
};

/// Where the hull_discs's discs are, from B, while the vehicle turns from one heading to another the short way.
/// @return offsets in W, discs of all headings on the way, close enough that no point of the hull_discs moves farther
/// than `step_m` from one to the next.
std::vector<HullDiscs::Disc> sweep(const HullDiscs& hull_discs, double from_rad, double to_rad, double step_m);

/// What the hull_discs would come too near to: on its way along a path, while it still turns.
class HullClearance {
 public:
  HullClearance() = default;
  /// @param step_m  by which the hull_discs's discs move at most from one heading that is looked at to the next.
  HullClearance(HullDiscs hull_discs, const Clearance& clearance, double step_m)
      : hull_discs_(std::move(hull_discs)), clearance_(clearance), step_m_(step_m) {}

  /// Sets what must be kept free from now on.
  void keep(const Clearance& clearance) { clearance_ = clearance; }
  /// Sets the headings that are passed meanwhile, the short way; where the vehicle is by then nobody knows, so that all
  /// of them count at every moment.
  void turn(double from_rad, double to_rad) { swept_ = sweep(hull_discs_, from_rad, to_rad, step_m_); }

  /// By how much a moment of a path lacks distance from obstacles and, if asked, from the unknown.
  ClearanceDeficit deficit(const LevelSlice& slice, const PathState& moment, bool unknown_too) const;

  /// How far the nose may turn, wherever on the path the vehicle then is, without coming nearer to anything than it
  /// may, or than it is already. @return a heading on the short way between both, rad.
  double free_turn_rad(const LevelSlice& slice, const std::vector<PathState>& path, double from_rad,
                       double to_rad) const;

 private:
  HullDiscs hull_discs_;
  Clearance clearance_;
  double step_m_ = 0.3;
  std::vector<HullDiscs::Disc> swept_;
};

}  // namespace hedgehop::avoidance::local_map
