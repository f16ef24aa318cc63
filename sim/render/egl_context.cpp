#include "sim/render/gl_context.h"

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace hedgehop::sim {
namespace {

bool has(const char* extensions, std::string_view name) {
  return extensions && std::string_view(extensions).find(name) != std::string_view::npos;
}

template <class Function>
Function entry(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

bool is_software(EGLDeviceEXT device) {
  const auto query = entry<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  return query && has(query(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
}

/// Returns the displays to try, in this order: hardware devices, software devices, Mesa's surfaceless platform.
std::vector<EGLDisplay> displays() {
  const auto display_of = entry<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  const auto query = entry<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  if (!display_of) return {};
  std::vector<EGLDisplay> found;
  EGLint count = 0;
  if (query && query(0, nullptr, &count) == EGL_TRUE && count > 0) {
    std::vector<EGLDeviceEXT> devices(static_cast<size_t>(count));
    query(count, devices.data(), &count);
    std::stable_partition(devices.begin(), devices.end(), [](EGLDeviceEXT device) { return !is_software(device); });
    for (EGLDeviceEXT device : devices) found.push_back(display_of(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
  }
  found.push_back(display_of(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  std::erase(found, EGL_NO_DISPLAY);
  return found;
}

/// Returns an OpenGL 3.3 core context that needs no surface, or EGL_NO_CONTEXT.
EGLContext context_on(EGLDisplay display) {
  const char* const extensions = eglQueryString(display, EGL_EXTENSIONS);
  if (!has(extensions, "EGL_KHR_surfaceless_context") || !has(extensions, "EGL_KHR_no_config_context")) {
    return EGL_NO_CONTEXT;
  }
  const EGLint attributes[] = {
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
}

class EglContext final : public GlContext {
 public:
  EglContext();
  ~EglContext() override;

  void make_current() override;

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

EglContext::EglContext() {
  const std::vector<EGLDisplay> candidates = displays();
  for (const EGLDisplay display : candidates) {
    if (eglInitialize(display, nullptr, nullptr) != EGL_TRUE || eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) continue;
    context_ = context_on(display);
    display_ = display;
    if (context_ != EGL_NO_CONTEXT) break;
  }
  if (context_ == EGL_NO_CONTEXT) {
    throw std::runtime_error(fmt::format(
        "EGL created no OpenGL 3.3 core context on any of {} displays (last EGL error {:#06x}). Install libegl1 and a "
        "driver such as libegl-mesa0, or use --renderer osmesa",
        candidates.size(), eglGetError()));
  }
  make_current();
  gl_ = load_gl(eglGetProcAddress, "EGL");
}

EglContext::~EglContext() {
  // Other contexts of this process share the display, so it is not terminated.
  if (eglGetCurrentContext() == context_) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

void EglContext::make_current() {
  if (eglGetCurrentContext() == context_) return;
  if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
    throw std::runtime_error(fmt::format("EGL refused the OpenGL context (error {:#06x})", eglGetError()));
  }
}

}  // namespace

std::unique_ptr<GlContext> make_egl_context() { return std::make_unique<EglContext>(); }

}  // namespace hedgehop::sim
