#include "sim/libm/many.h"

#include <immintrin.h>

#include <cmath>
#include <cstddef>

// SLEEF's variants without fused multiply-add have equal bits for all register widths. Its header declares only those
// of the processor that the file is compiled for.
extern "C" {
__m256d Sleef_cinz_atan2d4_u10avx(__m256d, __m256d);
__m512d Sleef_cinz_atan2d8_u10avx512fnofma(__m512d, __m512d);
}

namespace hedgehop {
namespace {

using By4 = __m256d (*)(__m256d, __m256d);
using By8 = __m512d (*)(__m512d, __m512d);

struct Numbers {
  const double *a, *b;
  double* out;
  size_t count;
};

// Both return how many numbers they computed.
[[gnu::target("avx")]] size_t compute(By4 function, const Numbers& n) {
  size_t i = 0;
  for (; i + 4 <= n.count; i += 4) {
    _mm256_storeu_pd(n.out + i, function(_mm256_loadu_pd(n.a + i), _mm256_loadu_pd(n.b + i)));
  }
  return i;
}
[[gnu::target("avx512f")]] size_t compute(By8 function, const Numbers& n) {
  size_t i = 0;
  for (; i + 8 <= n.count; i += 8) {
    _mm512_storeu_pd(n.out + i, function(_mm512_loadu_pd(n.a + i), _mm512_loadu_pd(n.b + i)));
  }
  return i;
}

void compute_each(By8 by_8, By4 by_4, double (*one)(double, double), const Numbers& n) {
  size_t done = 0;
  if (__builtin_cpu_supports("avx512f")) {
    done = compute(by_8, n);
  } else if (__builtin_cpu_supports("avx")) {
    done = compute(by_4, n);
  }
  for (size_t i = done; i < n.count; ++i) n.out[i] = one(n.a[i], n.b[i]);
}

}  // namespace

void atan2_of_each(std::span<const double> y, std::span<const double> x, std::span<double> out) {
  compute_each(Sleef_cinz_atan2d8_u10avx512fnofma, Sleef_cinz_atan2d4_u10avx, std::atan2,
               {y.data(), x.data(), out.data(), out.size()});
}

}  // namespace hedgehop
