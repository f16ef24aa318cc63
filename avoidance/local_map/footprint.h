#pragma once

#include <utility>
#include <vector>

#include "avoidance/local_map/level_slice.h"
#include "avoidance/local_map/outline.h"
#include "avoidance/local_map/stop_planner.h"

namespace hedgehop::avoidance::local_map {

/// What the outline would come too near to: on its way along a path, while it still turns.
class Footprint {
 public:
  Footprint() = default;
  /// @param step_m  by which the outline's discs move at most from one heading that is looked at to the next.
  Footprint(Outline outline, const Clearance& clearance, double step_m)
      : outline_(std::move(outline)), clearance_(clearance), step_m_(step_m) {}

  /// Sets what must be kept free from now on.
  void keep(const Clearance& clearance) { clearance_ = clearance; }
  /// Sets the headings that are passed meanwhile, the short way; where the vehicle is by then nobody knows, so that all
  /// of them count at every moment.
  void turn(double from_rad, double to_rad) { swept_ = sweep(outline_, from_rad, to_rad, step_m_); }

  /// By how much a moment of a path lacks distance from obstacles and, if asked, from the unknown.
  Fault fault(const LevelSlice& slice, const Moment& moment, bool unknown_too) const;

  /// How far the nose may turn, wherever on the path the vehicle then is, without coming nearer to anything than it
  /// may, or than it is already. @return a heading on the short way between both, rad.
  double turn_as_far_as_free_rad(const LevelSlice& slice, const std::vector<Moment>& path, double from_rad,
                                 double to_rad) const;

 private:
  Outline outline_;
  Clearance clearance_;
  double step_m_ = 0.3;
  std::vector<Outline::Disc> swept_;
};

}  // namespace hedgehop::avoidance::local_map
