#pragma once

namespace hedgehop::sim {

/// Who draws, without a display.
enum class ContextKind {
  osmesa,  ///< OpenGL by Mesa's software rasterizer behind OSMesa
  egl,     ///< OpenGL by EGL without a surface: a GPU where there is one, else the same rasterizer
  tiles,   ///< our own rasterizer for processors with AVX2
};

/// Whether what stands between a surface and the sun darkens it.
enum class Shadows { none, sun };

/// How much of a scene is left out before it is drawn. Images do not depend on it, only their cost does (except a
/// pixel in a crack of a mesh, which may show something else behind).
enum class Culling { none, frustum, frustum_and_horizon };

}  // namespace hedgehop::sim
