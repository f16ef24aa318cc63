#pragma once

#include <cstdlib>
#include <string_view>

#include "sim/render/renderer.h"

namespace hedgehop::sim {

/// Who draws in this run of the tests: all of them are run once for OSMesa and once for tiles.
inline RendererKind tested_context() {
  const char* const name = std::getenv("HEDGEHOP_TEST_GL");
  return name != nullptr && std::string_view(name) == "tiles" ? RendererKind::tiles : RendererKind::osmesa;
}

inline Renderer drawing(const scenes::Scene& scene, Culling culling = Culling::frustum_and_horizon,
                        Shadows shadows = Shadows::none) {
  return Renderer(scene, culling, tested_context(), shadows);
}

}  // namespace hedgehop::sim
