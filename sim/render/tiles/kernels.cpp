#include "sim/render/tiles/kernels.h"

#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace hedgehop::sim::tiles {
namespace {

struct NamedKernels {
  std::string_view name;
  const Kernels* kernels;
};

/// Those that this processor can run, the fastest first.
std::vector<NamedKernels> runnable_kernels() {
  std::vector<NamedKernels> runnable;
#ifdef __x86_64__
  const bool avx512 =
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  if (avx512) runnable.push_back({"avx512", &kAvx512Kernels});
  if (__builtin_cpu_supports("avx2")) runnable.push_back({"avx2", &kAvx2Kernels});
#endif
  return runnable;
}

}  // namespace

const Kernels& chosen_kernels() {
  const char* const name = std::getenv("HEDGEHOP_TILES");
  const std::string_view asked = name == nullptr ? "" : name;
  if (asked == "plain") return kPlainKernels;
  for (const NamedKernels& found : runnable_kernels()) {
    if (asked.empty() || asked == found.name) return *found.kernels;
  }
  if (asked.empty()) {
    throw std::runtime_error(
        "tiles draws with AVX2, which this processor lacks; --renderer osmesa needs none, HEDGEHOP_TILES=plain draws "
        "slowly");
  }
  throw std::runtime_error(fmt::format(
      "HEDGEHOP_TILES={}: this processor has no such kernels; avx512, avx2 or plain, and the fastest when not given",
      asked));
}

}  // namespace hedgehop::sim::tiles
