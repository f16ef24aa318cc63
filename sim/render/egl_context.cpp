#include "sim/render/gl_context.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "sim/render/egl_interface.h"
#include "sim/render/renderer_library.h"

namespace hedgehop::sim {
namespace {

bool has(const char* extensions, std::string_view name) {
  return extensions && std::string_view(extensions).find(name) != std::string_view::npos;
}

#define HEDGEHOP_EGL_CONSTANT(NAME, VALUE) constexpr EGLint EGL_##NAME = VALUE;
HEDGEHOP_EGL_CONSTANTS(HEDGEHOP_EGL_CONSTANT)
#undef HEDGEHOP_EGL_CONSTANT

struct EglFunctions {
#define HEDGEHOP_EGL_MEMBER(RESULT, NAME, PARAMETERS) RESULT(*NAME) PARAMETERS = nullptr;
  HEDGEHOP_EGL_FUNCTIONS(HEDGEHOP_EGL_MEMBER)
  HEDGEHOP_EGL_EXTENSION_FUNCTIONS(HEDGEHOP_EGL_MEMBER)  // null if the library has no such extension
#undef HEDGEHOP_EGL_MEMBER
};

/// Loads EGL at the first call that finds it.
const EglFunctions& egl() {
  static const EglFunctions functions = [] {
    const RendererLibrary library("libEGL.so.1", "libegl1 and a driver such as libegl-mesa0");
    EglFunctions found;
#define HEDGEHOP_EGL_FIND(RESULT, NAME, PARAMETERS) library.find(found.NAME, "egl" #NAME);
    HEDGEHOP_EGL_FUNCTIONS(HEDGEHOP_EGL_FIND)
#undef HEDGEHOP_EGL_FIND
#define HEDGEHOP_EGL_FIND(RESULT, NAME, PARAMETERS) \
  found.NAME = reinterpret_cast<RESULT(*) PARAMETERS>(found.GetProcAddress("egl" #NAME));
    HEDGEHOP_EGL_EXTENSION_FUNCTIONS(HEDGEHOP_EGL_FIND)
#undef HEDGEHOP_EGL_FIND
    return found;
  }();
  return functions;
}

bool is_software(EGLDeviceEXT device) {
  return egl().QueryDeviceStringEXT &&
         has(egl().QueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
}

/// Returns the displays to try, in this order: hardware devices, software devices, Mesa's surfaceless platform.
std::vector<EGLDisplay> displays() {
  const auto display_of = egl().GetPlatformDisplayEXT;
  const auto query = egl().QueryDevicesEXT;
  if (!display_of) return {};
  std::vector<EGLDisplay> found;
  EGLint count = 0;
  if (query && query(0, nullptr, &count) == EGL_TRUE && count > 0) {
    std::vector<EGLDeviceEXT> devices(static_cast<size_t>(count));
    query(count, devices.data(), &count);
    std::stable_partition(devices.begin(), devices.end(), [](EGLDeviceEXT device) { return !is_software(device); });
    for (EGLDeviceEXT device : devices) found.push_back(display_of(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
  }
  found.push_back(display_of(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr));
  std::erase(found, nullptr);
  return found;
}

/// Returns an OpenGL 3.3 core context that needs no surface, or nullptr.
EGLContext context_on(EGLDisplay display) {
  const char* const extensions = egl().QueryString(display, EGL_EXTENSIONS);
  if (!has(extensions, "EGL_KHR_surfaceless_context") || !has(extensions, "EGL_KHR_no_config_context")) {
    return nullptr;
  }
  const EGLint attributes[] = {
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  return egl().CreateContext(display, nullptr, nullptr, attributes);
}

class EglGlContext final : public GlContext {
 public:
  EglGlContext();
  ~EglGlContext() override;

  RendererKind kind() const override { return RendererKind::egl; }

 private:
  void bind() override;
  Unbind* unbind() const override {
    return [] { egl().MakeCurrent(egl().GetCurrentDisplay(), nullptr, nullptr, nullptr); };
  }

  EGLDisplay display_ = nullptr;
  EGLContext context_ = nullptr;
};

EglGlContext::EglGlContext() {
  const std::vector<EGLDisplay> candidates = displays();
  for (const EGLDisplay display : candidates) {
    if (egl().Initialize(display, nullptr, nullptr) != EGL_TRUE || egl().BindAPI(EGL_OPENGL_API) != EGL_TRUE) continue;
    context_ = context_on(display);
    display_ = display;
    if (context_ != nullptr) break;
  }
  if (context_ == nullptr) {
    throw std::runtime_error(fmt::format(
        "EGL created no OpenGL 3.3 core context on any of {} displays (last EGL error {:#06x}); install libegl1 "
        "and a driver such as libegl-mesa0",
        candidates.size(), egl().GetError()));
  }
  make_current();
  gl_ = load_gl(egl().GetProcAddress, "EGL");
}

EglGlContext::~EglGlContext() {
  // Other contexts of this process share the display, so it is not terminated.
  if (egl().GetCurrentContext() == context_) egl().MakeCurrent(display_, nullptr, nullptr, nullptr);
  egl().DestroyContext(display_, context_);
}

void EglGlContext::bind() {
  if (egl().GetCurrentContext() == context_) return;
  if (egl().MakeCurrent(display_, nullptr, nullptr, context_) != EGL_TRUE) {
    throw std::runtime_error(fmt::format("EGL refused the OpenGL context (error {:#06x})", egl().GetError()));
  }
}

}  // namespace

std::unique_ptr<GlContext> make_egl_context() { return std::make_unique<EglGlContext>(); }

}  // namespace hedgehop::sim
