#pragma once

#include <cstddef>

#include "scenes/scene.h"

namespace hedgehop::scenes {

/// How cramped a scene is, from its solids alone. "In the plan" means the solids' axis-aligned outlines seen from
/// above.
struct SceneFigures {
  size_t solids = 0;
  double smallest_gap_m = 0.0;  ///< in the plan, between solids that do not touch; +inf without two such solids
  double covered_share = 0.0;   ///< of Scene::bounds_NE_m, by solids that stand on the ground and do not overlap
};

/// Cost: a sweep along north, near linear in the number of solids for a city.
SceneFigures scene_figures(const Scene& scene);

}  // namespace hedgehop::scenes
