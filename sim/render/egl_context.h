#pragma once

#include "sim/render/gl_context.h"

namespace hedgehop::sim {

/// OpenGL from EGL without any surface. Takes the first device that is hardware, else Mesa's software device.
class EglContext final : public GlContext {
 public:
  /// Throws std::runtime_error with the cause when there is no such context or an entry point is missing.
  EglContext();
  ~EglContext() override;

  void make_current() override;

 private:
  // EGLDisplay and EGLContext; EGL's header brings a window system's along, which nobody else should see.
  void* display_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace hedgehop::sim
