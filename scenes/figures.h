#pragma once

#include <cstddef>
#include <limits>

#include "scenes/scene.h"

namespace hedgehop::scenes {

/// How cramped a scene is, from its solids alone: its difficulty. In the plan, upright cylinders and spheres are discs,
/// all others their axis-aligned outlines seen from above. The gap of a solid is its distance to the nearest solid that
/// it does not touch.
struct SceneFigures {
  size_t solids = 0;
  double smallest_gap_m = 0.0;  ///< of all solids; +inf without two that do not touch
  double median_gap_m = 0.0;    ///< over the solids, the upper one of two; +inf without two that do not touch
  double covered_share = 0.0;   ///< of Scene::bounds_NE_m, by solids that stand on the ground and do not overlap
  double density_pm2 = 0.0;     ///< solids that stand on the ground inside of the bounds, to a square meter of them
};

/// Heights above W's origin, m.
struct AltitudeRange {
  double lowest_m = -std::numeric_limits<double>::infinity();
  double highest_m = std::numeric_limits<double>::infinity();
};

/// @param band  only solids that reach into it count.
/// Cost: a sweep along north, near linear in the number of solids for a city.
SceneFigures scene_figures(const Scene& scene, const AltitudeRange& band = {});

}  // namespace hedgehop::scenes
