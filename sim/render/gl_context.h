#pragma once

#include <memory>

#include "sim/render/gl_functions.h"
#include "sim/scenario/drawing.h"

namespace hedgehop::sim {

/// An OpenGL 3.3 core context that needs no display. Destroying it frees every object made in it.
class GlContext {
 public:
  virtual ~GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Makes the context the calling thread's current one; cheap when it is already.
  virtual void make_current() = 0;
  const GlFunctions& gl() const { return gl_; }

 protected:
  GlContext() = default;
  GlFunctions gl_;  ///< for load_gl() in the constructor
};

/// @param kind  osmesa or egl. Throws std::runtime_error with the cause when there is no such context or an entry point
/// is missing. Mesa's rasterizer threads are switched off unless the environment has LP_NUM_THREADS.
std::unique_ptr<GlContext> make_context(RendererKind kind);

}  // namespace hedgehop::sim
