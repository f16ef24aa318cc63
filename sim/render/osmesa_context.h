#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "sim/render/gl_context.h"

struct osmesa_context;

namespace hedgehop::sim {

/// Mesa's software rasterizer behind OSMesa.
class OsmesaContext final : public GlContext {
 public:
  /// Throws std::runtime_error with the cause when there is no such context or an entry point is missing.
  OsmesaContext();

  void make_current() override;

 private:
  struct Destroy {
    void operator()(osmesa_context* context) const;
  };
  std::unique_ptr<osmesa_context, Destroy> context_;
  std::array<uint32_t, 16> window_{};  // OSMesa wants a default framebuffer, 4 x 4 RGBA; nothing is drawn there
};

}  // namespace hedgehop::sim
