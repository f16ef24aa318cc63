#pragma once

#include <Eigen/Core>
#include <vector>

#include "avoidance/module.h"

namespace hedgehop::avoidance::local_map {

/// The vehicle's outline in the plan, level, as discs that together hold it. Of a multicopter one is enough; a
/// helicopter's tail boom, longer than its rotor, swings about as it turns.
class Outline {
 public:
  struct Disc {
    Eigen::Vector2d p_H;  ///< middle, m: x along the heading, y to the right
    double radius_m;      ///< > 0
  };

  Outline() = default;
  /// One disc for each box, several along a long one. A box whose corner lies beyond the cylinder that holds the
  /// vehicle holds a rotor: the disc in it counts. Where discs save little, or no boxes are given, that cylinder is the
  /// outline.
  explicit Outline(const VehicleLimits& limits);

  const std::vector<Disc>& discs() const { return discs_; }

 private:
  std::vector<Disc> discs_;
};

/// Where the outline's discs are, from B, while the vehicle turns from one heading to another the short way.
/// @return offsets in W, discs of all headings on the way, close enough that no point of the outline moves farther
/// than `step_m` from one to the next.
std::vector<Outline::Disc> sweep(const Outline& outline, double from_rad, double to_rad, double step_m);

}  // namespace hedgehop::avoidance::local_map
