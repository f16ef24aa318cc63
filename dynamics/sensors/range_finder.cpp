#include "dynamics/sensors/range_finder.h"

#include <stdexcept>

#include "sim/fields/bounds.h"
#include "sim/fields/invalid_field.h"

namespace hedgehop::dynamics::sensors {

Eigen::Vector3d beam_direction_B(const RangeFinderConfig& config) {
  fields::require_bounds(config, "range_finder");
  if (config.direction_B.isZero(0.0)) {
    throw fields::InvalidField("range_finder.direction", "must not be zero");
  }
  return config.direction_B.stableNormalized();
}

}  // namespace hedgehop::dynamics::sensors
