#include "dynamics/sensors/height_sensor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hedgehop::dynamics::sensors {
namespace {

constexpr double kRingSpacingM = 0.5;  // chosen: obstacles on roofs and the ground are rarely narrower

}  // namespace

double nearest_echo_m(const HeightSensorConfig& config, double below_m, const HeightBeside& beside) {
  if (config.cone_rad == 0.0 || !beside) return below_m;
  double nearest_m = below_m;
  const double reach_m = config.ranger.max_m * std::sin(config.cone_rad);
  const int rings = static_cast<int>(std::ceil(reach_m / kRingSpacingM));
  for (int ring = 1; ring <= rings; ++ring) {
    const double radius_m = reach_m * ring / rings;
    const int points = 6 * ring;  // as far apart as the rings
    for (int i = 0; i < points; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / points;
      const double height_m = beside(radius_m * std::cos(angle), radius_m * std::sin(angle));
      if (height_m * std::tan(config.cone_rad) < radius_m) continue;  // outside the cone
      nearest_m = std::min(nearest_m, std::hypot(height_m, radius_m));
    }
  }
  return nearest_m;
}

}  // namespace hedgehop::dynamics::sensors
