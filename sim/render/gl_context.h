#pragma once

#include <memory>

#include "sim/render/gl_functions.h"
#include "sim/scenario/drawing.h"

namespace hedgehop::sim {

/// An OpenGL 3.3 core context that needs no display. Destroying the context frees every object created in it.
class GlContext {
 public:
  virtual ~GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Makes this context the current one of the calling thread. Cheap if it is current already.
  virtual void make_current() = 0;
  const GlFunctions& gl() const { return gl_; }

 protected:
  GlContext() = default;
  GlFunctions gl_;  ///< set by the constructors of the implementations
};

/// Returns a context of OSMesa or EGL. Mesa's rasterizer threads are off unless the environment sets LP_NUM_THREADS.
/// @param kind  osmesa or egl.
/// Throws std::runtime_error with the cause if the context cannot be created or lacks a function, and InputError if an
/// environment variable changes Mesa's version or extensions.
std::unique_ptr<GlContext> make_context(RendererKind kind);

/// Returns an EGL context without a surface: on the first hardware device, else on Mesa's software device.
/// Throws as make_context() does, also if this build has no EGL.
std::unique_ptr<GlContext> make_egl_context();

}  // namespace hedgehop::sim
