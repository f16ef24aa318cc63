#include "dynamics/air/gust.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hedgehop::dynamics::air {

double gust_speed_mps(const GustConfig& c, double path_m) {
  const double whole_m = 2.0 * c.length_m + c.hold_m;
  const double from_edge_m = std::clamp(std::min(path_m, whole_m - path_m), 0.0, c.length_m);
  return 0.5 * c.speed_mps * (1.0 - std::cos(std::numbers::pi * from_edge_m / c.length_m));
}

}  // namespace hedgehop::dynamics::air
