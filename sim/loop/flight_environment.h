#pragma once

#include <memory>
#include <vector>

#include "dynamics/hull.h"
#include "scenes/scene.h"
#include "scenes/scene_files.h"
#include "sim/collision/proximity.h"
#include "sim/render/renderer.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// The scene, collision world and renderer of a flight, which are slow to build. It serves any number of flights of one
/// scenario and seed, one at a time; a flight leaves no state in it.
struct FlightEnvironment {
  /// Throws InputError for an invalid scene, std::runtime_error if no context can be created.
  explicit FlightEnvironment(const Scenario& scenario);
  /// As above. @param files  that the validation of this scenario has read.
  FlightEnvironment(const Scenario& scenario, scenes::SceneFiles files);

  std::shared_ptr<const scenes::Scene> scene;
  std::vector<dynamics::HullPart> hull;
  CollisionWorld collision;
  Renderer renderer;
};

}  // namespace hedgehop::sim
