#include "dynamics/sensors/range_finder.h"

#include <stdexcept>

namespace hedgehop::dynamics::sensors {

Eigen::Vector3d beam_direction_B(const RangeFinderConfig& config) {
  if (!config.direction_B.allFinite() || config.direction_B.isZero(0.0)) {
    throw std::invalid_argument("range_finder.direction: must be finite and not zero");
  }
  if (!config.p_BI_m.allFinite()) throw std::invalid_argument("range_finder.position: must be finite");
  return config.direction_B.stableNormalized();
}

}  // namespace hedgehop::dynamics::sensors
