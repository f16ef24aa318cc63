#include "sim/render/tiles/kernels.h"

#include <fmt/format.h>

#include <cstdlib>
#include <string_view>
#include <vector>

#include "sim/config/input_error.h"

namespace hedgehop::sim::tiles {
namespace {

struct NamedKernels {
  std::string_view name;
  const Kernels* kernels;
};

/// Returns the kernels that this processor supports, fastest first.
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
  const std::string_view requested = name == nullptr ? "" : name;
  if (requested == "plain") return kPlainKernels;
  for (const NamedKernels& found : runnable_kernels()) {
    if (requested.empty() || requested == found.name) return *found.kernels;
  }
  if (requested.empty()) {
    throw InputError(
        "tiles: not available: this processor lacks AVX2; use --renderer osmesa, or HEDGEHOP_TILES=plain, which is "
        "slow");
  }
  throw InputError(
      fmt::format("HEDGEHOP_TILES={}: unknown, or not supported by this processor; valid: avx512, avx2, plain "
                  "(default: the fastest)",
                  requested));
}

}  // namespace hedgehop::sim::tiles
