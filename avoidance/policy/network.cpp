#include "avoidance/policy/network.h"

#include <stdexcept>

#include "sim/fields/own_library.h"

namespace hedgehop::avoidance::policy {

std::unique_ptr<Network> read_network(const std::filesystem::path& onnx) {
#ifdef HEDGEHOP_DNN
  auto* const make = own_library_function<MakeNetwork, std::invalid_argument>(kNetworkLibrary, kMakeNetwork,
                                                                              "this installation reads no networks: ");
  std::unique_ptr<Network> made;
  make(onnx, made);
  return made;
#else
  (void)onnx;
  throw std::invalid_argument("this build reads no networks: install libopencv-dnn-dev and build again");
#endif
}

}  // namespace hedgehop::avoidance::policy
