#include "avoidance/policy/network.h"

#include <dlfcn.h>

#include <stdexcept>

namespace hedgehop::avoidance::policy {

std::unique_ptr<Network> read_network(const std::filesystem::path& onnx) {
#ifdef HEDGEHOP_DNN
  // It remains loaded. It is found by the run path of this code.
  void* const library = ::dlopen(kNetworkLibrary, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr)
    throw std::invalid_argument(std::string("this installation reads no networks: ") + ::dlerror());
  auto* const make = reinterpret_cast<MakeNetwork*>(::dlsym(library, kMakeNetwork));
  if (make == nullptr)
    throw std::invalid_argument(std::string("libhedgehop_network.so belongs to another build: ") + ::dlerror());
  std::unique_ptr<Network> made;
  make(onnx, made);
  return made;
#else
  (void)onnx;
  throw std::invalid_argument("this build reads no networks: install libopencv-dnn-dev and build again");
#endif
}

}  // namespace hedgehop::avoidance::policy
