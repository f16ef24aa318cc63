#include "sim/render/gl_functions.h"

#include <fmt/format.h>

#include <stdexcept>

namespace hedgehop::sim {

void check_gl(const GlFunctions& gl, const char* what) {
  if (const GLenum error = gl.GetError(); error != GL_NO_ERROR) {
    throw std::runtime_error(fmt::format("OpenGL error {:#06x} while {}", error, what));
  }
}

}  // namespace hedgehop::sim
