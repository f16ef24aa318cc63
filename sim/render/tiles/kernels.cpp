#include "sim/render/tiles/kernels.h"

#include <cstdlib>
#include <stdexcept>
#include <string_view>

namespace hedgehop::sim::tiles {

const Kernels& chosen_kernels() {
  const char* const name = std::getenv("HEDGEHOP_TILES");
  if (name != nullptr && std::string_view(name) == "plain") return kPlainKernels;
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2")) return kAvx2Kernels;
#endif
  throw std::runtime_error(
      "tiles draws with AVX2, which this processor lacks; --gl osmesa needs none, HEDGEHOP_TILES=plain draws slowly");
}

}  // namespace hedgehop::sim::tiles
