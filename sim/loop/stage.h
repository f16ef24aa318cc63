#pragma once

#include <memory>
#include <vector>

#include "dynamics/hull.h"
#include "scenes/scene.h"
#include "sim/collision/proximity.h"
#include "sim/render/renderer.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// What a flight flies through, what may touch it, and who draws it: all that takes long to make. Serves any number of
/// flights of one scenario and seed, one at a time; none leaves a trace in it that another could see.
struct Stage {
  /// Throws InputError for a scene that cannot be, std::runtime_error when there is no context to draw in.
  explicit Stage(const Scenario& scenario);

  std::shared_ptr<const scenes::Scene> scene;
  std::vector<dynamics::HullPart> hull;
  CollisionWorld collision;
  Renderer renderer;
};

}  // namespace hedgehop::sim
