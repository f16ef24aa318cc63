#include <stdexcept>

#include "sim/render/gl_context.h"

namespace hedgehop::sim {

std::unique_ptr<GlContext> make_egl_context() {
  throw std::runtime_error("this build of Hedgehop has no EGL (hedgehop --version --features)");
}

}  // namespace hedgehop::sim
