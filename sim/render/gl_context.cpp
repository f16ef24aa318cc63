#include "sim/render/gl_context.h"

#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>
#include <type_traits>

#include "sim/config/input_error.h"

namespace hedgehop::sim {

GlFunctions load_gl(void (*(*address)(const char* name))(), const char* library) {
  GlFunctions gl;
  const auto load = [&](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(address(name));
    if (!function) throw std::runtime_error(fmt::format("{} has no {}; install Mesa 21 or later", library, name));
  };
#define HEDGEHOP_GL_LOAD(RESULT, NAME, PARAMETERS) load(gl.NAME, "gl" #NAME);
  HEDGEHOP_GL_FUNCTIONS(HEDGEHOP_GL_LOAD)
#undef HEDGEHOP_GL_LOAD
  return gl;
}

void check_gl(const GlFunctions& gl, const char* activity) {
  if (const GLenum error = gl.GetError(); error != GL_NO_ERROR) {
    throw std::runtime_error(fmt::format("OpenGL error {:#06x} while {}", error, activity));
  }
}

void GlContext::make_current() {
  // OSMesa and EGL share the current context of Mesa, and each reports the last one that it has set itself.
  thread_local Unbind* unbind_last = nullptr;
  if (unbind_last != nullptr && unbind_last != unbind()) unbind_last();
  unbind_last = unbind();
  bind();
}

namespace {

/// Throws std::runtime_error if the environment changes the version or the extensions of Mesa. Images would differ, or
/// Mesa would end the program.
void require_unchanged_mesa() {
  for (const char* const name : {"MESA_EXTENSION_OVERRIDE", "MESA_EXTENSION_MAX_YEAR", "MESA_GL_VERSION_OVERRIDE",
                                 "MESA_GLSL_VERSION_OVERRIDE"}) {
    if (std::getenv(name) == nullptr) continue;
    throw std::runtime_error(fmt::format("{} is set, which changes Mesa; unset it", name));
  }
}

std::unique_ptr<GlContext> make_any_context(RendererKind kind) {
  require_unchanged_mesa();
  setenv("LP_NUM_THREADS", "0", /*overwrite=*/0);
  switch (kind) {
    case RendererKind::osmesa:
      return make_osmesa_context();
    case RendererKind::egl:
      return make_egl_context();
    case RendererKind::tiles:
      break;
  }
  throw std::logic_error("tiles has no OpenGL context");
}

}  // namespace

std::unique_ptr<GlContext> make_context(RendererKind kind) {
  try {
    return make_any_context(kind);
  } catch (const std::runtime_error& fault) {
    throw InputError(fmt::format("{}: not available: {}; --renderer tiles needs no Mesa",
                                 kRendererNames[static_cast<size_t>(kind)], fault.what()));
  }
}

}  // namespace hedgehop::sim
