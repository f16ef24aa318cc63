#include <array>
#include <cstdint>
#include <stdexcept>

#include "sim/render/gl_context.h"
#include "sim/render/osmesa_interface.h"
#include "sim/render/renderer_library.h"

#ifdef __SANITIZE_ADDRESS__
// OSMesa leaks a few hundred bytes per context, and assimp leaks 44 bytes per broken glTF file. The list of
// suppressions is not printed, because tests compare the last line of a flight's output.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa\nleak:libassimp"; }
extern "C" const char* __lsan_default_options();
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }
#endif

namespace hedgehop::sim {
namespace {

#define HEDGEHOP_OSMESA_CONSTANT(NAME, VALUE) constexpr int OSMESA_##NAME = VALUE;
HEDGEHOP_OSMESA_CONSTANTS(HEDGEHOP_OSMESA_CONSTANT)
#undef HEDGEHOP_OSMESA_CONSTANT

struct OsmesaFunctions {
#define HEDGEHOP_OSMESA_MEMBER(RESULT, NAME, PARAMETERS) RESULT(*NAME) PARAMETERS = nullptr;
  HEDGEHOP_OSMESA_FUNCTIONS(HEDGEHOP_OSMESA_MEMBER)
#undef HEDGEHOP_OSMESA_MEMBER
};

/// Loads OSMesa at the first call that finds it.
const OsmesaFunctions& osmesa() {
  static const OsmesaFunctions functions = [] {
    const RendererLibrary library("libOSMesa.so.8", "libosmesa6");
    OsmesaFunctions found;
#define HEDGEHOP_OSMESA_FIND(RESULT, NAME, PARAMETERS) library.find(found.NAME, "OSMesa" #NAME);
    HEDGEHOP_OSMESA_FUNCTIONS(HEDGEHOP_OSMESA_FIND)
#undef HEDGEHOP_OSMESA_FIND
    return found;
  }();
  return functions;
}

/// Mesa's software rasterizer behind OSMesa.
class OsmesaGlContext final : public GlContext {
 public:
  OsmesaGlContext();

  RendererKind kind() const override { return RendererKind::osmesa; }

 private:
  void bind() override;
  Unbind* unbind() const override {
    return [] { osmesa().MakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); };
  }

  struct Destroy {
    void operator()(OSMesaContext context) const { osmesa().DestroyContext(context); }
  };
  std::unique_ptr<osmesa_context, Destroy> context_;
  std::array<uint32_t, 16> window_{};  // OSMesa requires a default framebuffer: 4 x 4 RGBA, never drawn to
};

OsmesaGlContext::OsmesaGlContext() {
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
  context_.reset(osmesa().CreateContextAttribs(attributes, nullptr));
  if (!context_) {
    throw std::runtime_error(
        "OSMesa created no OpenGL 3.3 core context (OSMesaCreateContextAttribs failed); install Mesa's llvmpipe, or "
        "unset "
        "GALLIUM_DRIVER if it names another driver");
  }
  make_current();
  gl_ = load_gl(osmesa().GetProcAddress, "OSMesa");
}

void OsmesaGlContext::bind() {
  if (osmesa().GetCurrentContext() == context_.get()) return;
  if (osmesa().MakeCurrent(context_.get(), window_.data(), GL_UNSIGNED_BYTE, 4, 4) != GL_TRUE) {
    throw std::runtime_error("OSMesaMakeCurrent refused the OpenGL context");
  }
}

}  // namespace

std::unique_ptr<GlContext> make_osmesa_context() { return std::make_unique<OsmesaGlContext>(); }

}  // namespace hedgehop::sim
