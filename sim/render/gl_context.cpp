#include "sim/render/gl_context.h"

#include <GL/osmesa.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <type_traits>

#include "sim/config/input_error.h"

#ifdef __SANITIZE_ADDRESS__
// OSMesa leaks a few hundred bytes per context, and assimp leaks 44 bytes per broken glTF file. The list of
// suppressions is not printed, because tests compare the last line of a flight's output.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa\nleak:libassimp"; }
extern "C" const char* __lsan_default_options();
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }
#endif

namespace hedgehop::sim {

GlFunctions load_gl(void (*(*address)(const char* name))(), const char* library) {
  GlFunctions gl;
  const auto load = [&](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(address(name));
    if (!function)
      throw std::runtime_error(fmt::format("{} has no {}; Hedgehop needs Mesa 21 or later", library, name));
  };
#define HEDGEHOP_GL_LOAD(TYPE, NAME) load(gl.NAME, "gl" #NAME);
  HEDGEHOP_GL_FUNCTIONS(HEDGEHOP_GL_LOAD)
#undef HEDGEHOP_GL_LOAD
  return gl;
}

void check_gl(const GlFunctions& gl, const char* activity) {
  if (const GLenum error = gl.GetError(); error != GL_NO_ERROR) {
    throw std::runtime_error(fmt::format("OpenGL error {:#06x} while {}", error, activity));
  }
}

namespace {

/// The functions of OSMesa in use.
struct Osmesa {
  decltype(&OSMesaCreateContextAttribs) create_context;
  decltype(&OSMesaDestroyContext) destroy_context;
  decltype(&OSMesaGetCurrentContext) current_context;
  decltype(&OSMesaMakeCurrent) make_current;
  decltype(&OSMesaGetProcAddress) address;
};

/// Loads OSMesa at the first call. Loading it with LLVM takes longer than the rest of the start of a program.
/// Throws std::runtime_error if it is not installed.
const Osmesa& osmesa() {
  static const Osmesa functions = [] {
    void* const library = dlopen("libOSMesa.so.8", RTLD_LAZY | RTLD_LOCAL);
    if (library == nullptr) {
      throw std::runtime_error(fmt::format("no OSMesa: {}; install Mesa's OSMesa (Debian: libosmesa6)", dlerror()));
    }
    Osmesa loaded{};
    const auto load = [library](auto& function, const char* name) {
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
      if (!function) throw std::runtime_error(fmt::format("OSMesa has no {}; Hedgehop needs Mesa 21 or later", name));
    };
    load(loaded.create_context, "OSMesaCreateContextAttribs");
    load(loaded.destroy_context, "OSMesaDestroyContext");
    load(loaded.current_context, "OSMesaGetCurrentContext");
    load(loaded.make_current, "OSMesaMakeCurrent");
    load(loaded.address, "OSMesaGetProcAddress");
    return loaded;
  }();
  return functions;
}

/// Mesa's software rasterizer behind OSMesa.
class OsmesaContext final : public GlContext {
 public:
  OsmesaContext();

  void make_current() override;

 private:
  struct Destroy {
    void operator()(osmesa_context* context) const { osmesa().destroy_context(context); }
  };
  std::unique_ptr<osmesa_context, Destroy> context_;
  std::array<uint32_t, 16> window_{};  // OSMesa requires a default framebuffer: 4 x 4 RGBA, never drawn to
};

OsmesaContext::OsmesaContext() {
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_DEPTH_BITS,
                            0,
                            OSMESA_STENCIL_BITS,
                            0,
                            OSMESA_ACCUM_BITS,
                            0,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            3,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            3,
                            0};
  context_.reset(osmesa().create_context(attributes, nullptr));
  if (!context_) {
    throw std::runtime_error(
        "OSMesa created no OpenGL 3.3 core context (OSMesaCreateContextAttribs failed). Install Mesa's llvmpipe; unset "
        "GALLIUM_DRIVER if it names another driver");
  }
  make_current();
  gl_ = load_gl(osmesa().address, "OSMesa");
}

void OsmesaContext::make_current() {
  if (osmesa().current_context() == context_.get()) return;
  if (osmesa().make_current(context_.get(), window_.data(), GL_UNSIGNED_BYTE, 4, 4) != GL_TRUE) {
    throw std::runtime_error("OSMesaMakeCurrent refused the OpenGL context");
  }
}

/// Throws InputError if the environment changes the version or the extensions of Mesa. Images would differ, or Mesa
/// would end the program.
void require_unchanged_mesa() {
  for (const char* const name : {"MESA_EXTENSION_OVERRIDE", "MESA_EXTENSION_MAX_YEAR", "MESA_GL_VERSION_OVERRIDE",
                                 "MESA_GLSL_VERSION_OVERRIDE"}) {
    if (std::getenv(name) == nullptr) continue;
    throw InputError(fmt::format("{} is set, which changes Mesa; unset it, or use --renderer tiles", name));
  }
}

}  // namespace

std::unique_ptr<GlContext> make_context(RendererKind kind) {
  require_unchanged_mesa();
  setenv("LP_NUM_THREADS", "0", /*overwrite=*/0);
  switch (kind) {
    case RendererKind::osmesa:
      return std::make_unique<OsmesaContext>();
    case RendererKind::egl:
      return make_egl_context();
    case RendererKind::tiles:
      break;
  }
  throw std::logic_error("tiles has no OpenGL context");
}

}  // namespace hedgehop::sim
