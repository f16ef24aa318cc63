#include "sim/render/renderer_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <stdexcept>

namespace hedgehop::sim {

RendererLibrary::RendererLibrary(const char* file, const char* package)
    : handle_(dlopen(file, RTLD_LAZY | RTLD_LOCAL)), file_(file) {
  if (handle_ == nullptr) throw std::runtime_error(fmt::format("{}; install {}", dlerror(), package));
}

void* RendererLibrary::address(const char* name) const {
  void* const found = dlsym(handle_, name);
  if (found == nullptr) {
    throw std::runtime_error(fmt::format("{} has no {}; install Mesa 21 or later", file_, name));
  }
  return found;
}

}  // namespace hedgehop::sim
