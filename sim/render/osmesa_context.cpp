#include "sim/render/osmesa_context.h"

#include <GL/osmesa.h>
#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>

#ifdef __SANITIZE_ADDRESS__
// OSMesa keeps 480 bytes for as long as the process lives, and loses sight of them.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa"; }
#endif

namespace hedgehop::sim {

namespace {

template <class Function>
void load(Function& function, const char* name) {
  function = reinterpret_cast<Function>(OSMesaGetProcAddress(name));
  if (function == nullptr) throw std::runtime_error(fmt::format("OSMesa has no {}; Mesa 21 or later is needed", name));
}

}  // namespace

void OsmesaContext::Destroy::operator()(osmesa_context* context) const { OSMesaDestroyContext(context); }

OsmesaContext::OsmesaContext() {
  setenv("LP_NUM_THREADS", "0", /*overwrite=*/0);
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
#define HEDGEHOP_GL_LOAD(TYPE, NAME) load(gl_.NAME, "gl" #NAME);
  HEDGEHOP_GL_FUNCTIONS(HEDGEHOP_GL_LOAD)
#undef HEDGEHOP_GL_LOAD
}

void OsmesaContext::make_current() {
  if (OSMesaGetCurrentContext() == context_.get()) return;
  if (OSMesaMakeCurrent(context_.get(), window_.data(), GL_UNSIGNED_BYTE, 4, 4) != GL_TRUE) {
    throw std::runtime_error("OSMesaMakeCurrent refused the OpenGL context");
  }
}

}  // namespace hedgehop::sim
