#include "vision/opencv_library.h"

#include <dlfcn.h>

#include <stdexcept>
#include <string>

namespace hedgehop::vision {

const OpenCvLibrary& opencv_library() {
  static const OpenCvLibrary& loaded = []() -> const OpenCvLibrary& {
    // It remains loaded. It is found by the run path of this code.
    void* const library = ::dlopen(kOpenCvLibrary, RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) throw std::runtime_error(std::string("incomplete installation: ") + ::dlerror());
    auto* const get = reinterpret_cast<GetOpenCvLibrary*>(::dlsym(library, kGetOpenCvLibrary));
    if (get == nullptr) throw std::runtime_error(std::string("incomplete installation: ") + ::dlerror());
    return get();
  }();
  return loaded;
}

}  // namespace hedgehop::vision
