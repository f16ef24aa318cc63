#include "dynamics/air/gust.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "dynamics/sensors/sensor_noise.h"

namespace hedgehop::dynamics::air {

void check(const GustConfig& c) {
  sensors::require_not_negative("gust.speed", c.speed_mps);
  if (!std::isfinite(c.from_rad)) throw std::invalid_argument("gust.from: must be finite");
  sensors::require_not_negative("gust.start", c.start_s);
  sensors::require_positive("gust.length", c.length_m);
  sensors::require_not_negative("gust.hold", c.hold_m);
}

double gust_speed_mps(const GustConfig& c, double path_m) {
  const double whole_m = 2.0 * c.length_m + c.hold_m;
  const double from_edge_m = std::clamp(std::min(path_m, whole_m - path_m), 0.0, c.length_m);
  return 0.5 * c.speed_mps * (1.0 - std::cos(std::numbers::pi * from_edge_m / c.length_m));
}

}  // namespace hedgehop::dynamics::air
