#include "sim/render/osmesa_context.h"

#include <GL/osmesa.h>
#include <fmt/format.h>

#include <stdexcept>

#ifdef __SANITIZE_ADDRESS__
// OSMesa leaks a few hundred bytes a context, assimp 44 of a broken glTF file. That they are left out is said nowhere:
// it would be a flight's last words.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa\nleak:libassimp"; }
extern "C" const char* __lsan_default_options();
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }
#endif

namespace hedgehop::sim {

void OsmesaContext::Destroy::operator()(osmesa_context* context) const { OSMesaDestroyContext(context); }

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
  context_.reset(OSMesaCreateContextAttribs(attributes, nullptr));
  if (!context_) {
    throw std::runtime_error(
        "no OpenGL 3.3 core context from OSMesa (OSMesaCreateContextAttribs failed); is Mesa's "
        "llvmpipe installed, and does GALLIUM_DRIVER name another driver?");
  }
  make_current();
  gl_ = load_gl(OSMesaGetProcAddress, "OSMesa");
}

void OsmesaContext::make_current() {
  if (OSMesaGetCurrentContext() == context_.get()) return;
  if (OSMesaMakeCurrent(context_.get(), window_.data(), GL_UNSIGNED_BYTE, 4, 4) != GL_TRUE) {
    throw std::runtime_error("OSMesaMakeCurrent refused the OpenGL context");
  }
}

}  // namespace hedgehop::sim
