#pragma once

#include <cstddef>
#include <limits>

#include "scenes/scene.h"

namespace hedgehop::scenes {

/// Measures of how dense a scene's obstacles are, computed from its solids. In the plan, upright cylinders and spheres
/// are discs, and all other solids are axis-aligned rectangles. The gap of a solid is its distance to the nearest solid
/// that it does not touch.
struct SceneFigures {
  size_t solids = 0;
  double smallest_gap_m = 0.0;  ///< minimum over the solids; +inf if all solids touch
  double median_gap_m = 0.0;    ///< over the solids, the upper of two middle values; +inf if all touch
  double covered_share = 0.0;   ///< of Scene::bounds_NE_m, by solids on the ground; overlaps count twice
  double density_pm2 = 0.0;     ///< solids on the ground within the bounds, per square meter of the bounds
};

/// Altitudes above W's origin, m.
struct AltitudeRange {
  double lowest_m = -std::numeric_limits<double>::infinity();
  double highest_m = std::numeric_limits<double>::infinity();
};

/// Returns the measures of a scene. @param band  solids outside this altitude range are ignored.
/// Cost: one sweep from south to north; for a city, nearly linear in the number of solids.
SceneFigures scene_figures(const Scene& scene, const AltitudeRange& band = {});

}  // namespace hedgehop::scenes
