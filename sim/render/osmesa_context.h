#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "sim/render/gl_functions.h"

struct osmesa_context;

namespace hedgehop::sim {

/// An OpenGL 3.3 core context that needs no display: Mesa's software rasteriser behind OSMesa. Destroying it frees
/// every object made in it.
class OsmesaContext {
 public:
  /// Throws std::runtime_error with the cause when there is no such context or an entry point is missing.
  OsmesaContext();

  /// Makes the context the calling thread's current one; cheap when it is already.
  void make_current();
  const GlFunctions& gl() const { return gl_; }

 private:
  struct Destroy {
    void operator()(osmesa_context* context) const;
  };
  std::unique_ptr<osmesa_context, Destroy> context_;
  std::array<uint32_t, 16> window_{};  // OSMesa wants a default framebuffer, 4 x 4 RGBA; nothing is drawn there
  GlFunctions gl_;
};

}  // namespace hedgehop::sim
