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

}  // namespace hedgehop::sim
