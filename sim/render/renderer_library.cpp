#include "sim/render/renderer_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace hedgehop::sim {

RendererLibrary::RendererLibrary(const char* file, const char* package)
    : handle_(dlopen(file, RTLD_LAZY | RTLD_LOCAL)), file_(file) {
  if (handle_ != nullptr) return;
  const std::string cause = dlerror();
  // The linker names the file that it does not find, which may also be one that this library needs.
  const bool is_absent = cause.starts_with(fmt::format("{}: cannot open shared object file: No such file", file));
  throw std::runtime_error(is_absent ? fmt::format("{}; install {}", cause, package)
                                     : fmt::format("{} cannot be loaded: {}", file, cause));
}

void* RendererLibrary::address(const char* name) const {
  void* const found = dlsym(handle_, name);
  if (found == nullptr) {
    throw std::runtime_error(fmt::format("{} has no {}; install Mesa 21 or later", file_, name));
  }
  return found;
}

}  // namespace hedgehop::sim
