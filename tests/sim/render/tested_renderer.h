#pragma once

#include <cstdlib>
#include <string_view>

#include "sim/render/renderer.h"

namespace hedgehop::sim {

/// Returns whether tiles is under test. All tests run once with OSMesa and once with tiles.
inline bool tests_tiles() {
  const char* const name = std::getenv("HEDGEHOP_TEST_RENDERER");
  return name != nullptr && std::string_view(name) == "tiles";
}

/// Returns a renderer of the kind under test.
inline Renderer make_renderer(const scenes::Scene& scene, Culling culling = Culling::frustum_and_horizon,
                              Shadows shadows = Shadows::none) {
  return Renderer(scene, culling, tests_tiles() ? RendererKind::tiles : RendererKind::osmesa, shadows);
}

}  // namespace hedgehop::sim
