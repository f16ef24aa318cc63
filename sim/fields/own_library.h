#pragma once

#include <dlfcn.h>

#include <stdexcept>
#include <string>

namespace hedgehop {

/// Returns a function of one of our shared libraries, which remains loaded. The library is found by the run path of the
/// calling code. Throws `Fault` with the prefix and the reason. @param prefix  of its message: "no encoder: ".
template <class Function, class Fault = std::runtime_error>
Function* own_library_function(const char* library, const char* name, const std::string& prefix) {
  void* const handle = ::dlopen(library, RTLD_NOW | RTLD_LOCAL);
  void* const function = handle != nullptr ? ::dlsym(handle, name) : nullptr;
  if (function == nullptr) throw Fault(prefix + ::dlerror());
  return reinterpret_cast<Function*>(function);
}

}  // namespace hedgehop
