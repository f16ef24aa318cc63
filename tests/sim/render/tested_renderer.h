#pragma once

#include <cstdlib>
#include <string_view>

#include "sim/render/renderer.h"

namespace hedgehop::sim {

/// Returns a renderer of the kind under test. All tests run once with OSMesa and once with tiles.
inline Renderer make_renderer(const scenes::Scene& scene, Culling culling = Culling::frustum_and_horizon,
                              Shadows shadows = Shadows::none) {
  const char* const name = std::getenv("HEDGEHOP_TEST_RENDERER");
  const bool tiles = name != nullptr && std::string_view(name) == "tiles";
  return Renderer(scene, culling, tiles ? RendererKind::tiles : RendererKind::osmesa, shadows);
}

}  // namespace hedgehop::sim
