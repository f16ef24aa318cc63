#include "sim/render/gl_functions.h"

#include <fmt/format.h>

#include <stdexcept>
#include <type_traits>

namespace hedgehop::sim {

GlFunctions load_gl(void (*(*address)(const char* name))(), const char* who) {
  GlFunctions gl;
  const auto load = [&](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(address(name));
    if (!function) throw std::runtime_error(fmt::format("{} has no {}; Mesa 21 or later is needed", who, name));
  };
#define HEDGEHOP_GL_LOAD(TYPE, NAME) load(gl.NAME, "gl" #NAME);
  HEDGEHOP_GL_FUNCTIONS(HEDGEHOP_GL_LOAD)
#undef HEDGEHOP_GL_LOAD
  return gl;
}

void check_gl(const GlFunctions& gl, const char* what) {
  if (const GLenum error = gl.GetError(); error != GL_NO_ERROR) {
    throw std::runtime_error(fmt::format("OpenGL error {:#06x} while {}", error, what));
  }
}

}  // namespace hedgehop::sim
