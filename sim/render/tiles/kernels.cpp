#include "sim/render/tiles/kernels.h"

namespace hedgehop::sim::tiles {

const Kernels& best_kernels() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2")) return kAvx2Kernels;
#endif
  return kPlainKernels;
}

}  // namespace hedgehop::sim::tiles
