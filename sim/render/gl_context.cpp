#include "sim/render/gl_context.h"

#include <cstdlib>
#include <stdexcept>

#include "sim/render/egl_context.h"
#include "sim/render/osmesa_context.h"

namespace hedgehop::sim {

std::unique_ptr<GlContext> make_context(RendererKind kind) {
  setenv("LP_NUM_THREADS", "0", /*overwrite=*/0);
  switch (kind) {
    case RendererKind::osmesa:
      return std::make_unique<OsmesaContext>();
    case RendererKind::egl:
      return std::make_unique<EglContext>();
    case RendererKind::tiles:
      break;
  }
  throw std::logic_error("a context without OpenGL");
}

}  // namespace hedgehop::sim
