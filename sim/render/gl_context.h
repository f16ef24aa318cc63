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
  void make_current();
  /// Returns the renderer that this context belongs to.
  virtual RendererKind kind() const = 0;
  const GlFunctions& gl() const { return gl_; }

 protected:
  GlContext() = default;
  using Unbind = void();
  GlFunctions gl_;  ///< set by the constructors of the implementations

 private:
  /// Makes the context current in its library, unless the library reports that it is.
  virtual void bind() = 0;
  /// Returns a function after which the library has no current context in the calling thread.
  virtual Unbind* unbind() const = 0;
};

/// Returns a context of OSMesa or EGL, never that of another renderer. Mesa's rasterizer threads are off unless the
/// environment sets LP_NUM_THREADS.
/// @param kind  osmesa or egl.
/// Throws InputError with the reason and a remedy if the renderer is not available: its library cannot be loaded or
/// lacks a function, it creates no context, or an environment variable changes Mesa's version or extensions.
std::unique_ptr<GlContext> make_context(RendererKind kind);

/// Returns a context of OSMesa. Throws std::runtime_error with the reason.
std::unique_ptr<GlContext> make_osmesa_context();

/// Returns an EGL context without a surface: on the first hardware device, else on Mesa's software device.
/// Throws std::runtime_error with the reason.
std::unique_ptr<GlContext> make_egl_context();

}  // namespace hedgehop::sim
