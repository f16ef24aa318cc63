#pragma once

#include <Eigen/Core>
#include <functional>

#include "dynamics/sensors/ranger.h"
#include "sim/fields/field.h"

namespace hedgehop::dynamics::sensors {

/// A laser of one beam, fixed to B, that ranges whatever the beam meets.
struct RangeFinderConfig {
  RangerConfig ranger = {.enabled = false, .min_m = 0.1, .max_m = 40.0, .latency_s = 0.01};
  Eigen::Vector3d direction_B = Eigen::Vector3d::UnitX();  ///< of the beam; any length but 0
  Eigen::Vector3d p_BI_m = Eigen::Vector3d::Zero();        ///< where the beam begins, from the mass center, in B
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<RangeFinderConfig> auto& c) {
  describe(v, c.ranger);
  v("direction", c.direction_B, {.meaning = "of the beam: forward, right, down; of any length but 0"});
  v("position", c.p_BI_m, {.unit = "m", .meaning = "where the beam begins: forward, right, down of the mass center"});
}

/// Distance from a point to what a beam meets, m; +inf where that is nothing within reach. @param p_W  m.
/// @param direction_W  of length 1. @param reach_m  > 0.
using BeamDistance =
    std::function<double(const Eigen::Vector3d& p_W, const Eigen::Vector3d& direction_W, double reach_m)>;

/// Returns the direction of the beam in B, of length 1. Throws std::invalid_argument when it has none, or when the
/// beam begins nowhere.
Eigen::Vector3d beam_direction_B(const RangeFinderConfig& config);

}  // namespace hedgehop::dynamics::sensors
