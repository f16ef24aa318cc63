#include <stdexcept>

#include "sim/render/egl_context.h"

namespace hedgehop::sim {

EglContext::EglContext() {
  throw std::runtime_error("this build of Hedgehop has no EGL (hedgehop --version --features)");
}
EglContext::~EglContext() = default;
void EglContext::make_current() {}

}  // namespace hedgehop::sim
