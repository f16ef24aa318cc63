#pragma once

#include <cstdint>
#include <cstring>

#ifdef __AVX2__
#include <immintrin.h>
#endif

// Vectors of eight pixels of a row, or of four corners, as vector types of the compiler. The kernels of all processors
// share this source. Each operation is exact or rounded once, so that all kernels give the same bits. All names have
// internal linkage, because the linker must not use the code of one processor for another.
namespace hedgehop::sim::tiles {
namespace {

using F8 = float __attribute__((vector_size(32)));
using I8 = int32_t __attribute__((vector_size(32)));
using D4 = double __attribute__((vector_size(32)));
using L4 = int64_t __attribute__((vector_size(32)));

using F4 = float __attribute__((vector_size(16)));

inline F8 all(float value) { return F8{} + value; }
inline I8 all(int32_t value) { return I8{} + value; }
inline D4 all(double value) { return D4{} + value; }
inline L4 all(int64_t value) { return L4{} + value; }

inline constexpr F8 kColumns = {0, 1, 2, 3, 4, 5, 6, 7};

template <class V, class M>
inline V pick(M where, V yes, V no) {
  return reinterpret_cast<V>((where & reinterpret_cast<M>(yes)) | (~where & reinterpret_cast<M>(no)));
}
inline F8 magnitude(F8 a) { return reinterpret_cast<F8>(reinterpret_cast<I8>(a) & 0x7fffffff); }
inline D4 magnitude(D4 a) { return reinterpret_cast<D4>(reinterpret_cast<L4>(a) & 0x7fffffffffffffff); }

inline F8 floats(I8 a) { return __builtin_convertvector(a, F8); }

/// Rounds to the nearest integer, ties to even. @param a  within +-2^51.
inline L4 integers(D4 a) {
  const D4 shift = all(6755399441055744.0);  // 1.5 * 2^52: the unit of the sum's last bit is 1
  return reinterpret_cast<L4>(a + shift) - reinterpret_cast<L4>(shift);
}

/// Expands each bit of a byte to a byte of ones.
struct ByteMasks {
  uint64_t bytes[256] = {};
  constexpr ByteMasks() {
    for (int bits = 0; bits < 256; ++bits) {
      for (int i = 0; i < 8; ++i) bytes[bits] |= (bits >> i & 1) != 0 ? uint64_t{0xff} << 8 * i : 0;
    }
  }
};
inline constexpr ByteMasks kByteMasks;

#ifdef __AVX2__

#ifdef __AVX512VL__
inline constexpr const char* kLanes = "AVX-512";
#else
inline constexpr const char* kLanes = "AVX2";
#endif

// Each returns the second operand if one is NaN.
inline F8 minimum(F8 a, F8 b) { return _mm256_min_ps(a, b); }
inline F8 maximum(F8 a, F8 b) { return _mm256_max_ps(a, b); }
inline D4 minimum(D4 a, D4 b) { return _mm256_min_pd(a, b); }
inline D4 maximum(D4 a, D4 b) { return _mm256_max_pd(a, b); }
inline I8 minimum(I8 a, I8 b) {
  return reinterpret_cast<I8>(_mm256_min_epi32(reinterpret_cast<__m256i>(a), reinterpret_cast<__m256i>(b)));
}
inline I8 maximum(I8 a, I8 b) {
  return reinterpret_cast<I8>(_mm256_max_epi32(reinterpret_cast<__m256i>(a), reinterpret_cast<__m256i>(b)));
}

/// Rounds to the nearest integer, ties to even. @param a  within +-2^31.
inline I8 integers(F8 a) { return reinterpret_cast<I8>(_mm256_cvtps_epi32(a)); }
inline F8 roots(F8 a) { return _mm256_sqrt_ps(a); }
/// @param a  within +-2^31.
inline L4 times(L4 a, int32_t b) {
  return reinterpret_cast<L4>(_mm256_mul_epi32(reinterpret_cast<__m256i>(a), _mm256_set1_epi64x(b)));
}
/// Returns the signs of the lanes, lane 0 in the lowest bit.
inline uint32_t signs(I8 a) {
  return static_cast<uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(reinterpret_cast<__m256i>(a))));
}
inline uint32_t signs(L4 a) {
  return static_cast<uint32_t>(_mm256_movemask_pd(_mm256_castsi256_pd(reinterpret_cast<__m256i>(a))));
}
/// Returns four bytes from each of eight 16-bit positions. Reads one by one, because the gather instruction is slower
/// on AMD Zen 3 and Zen 5.
inline I8 gather(const uint16_t* from, const int32_t* places) {
  const auto four = [&](int i) {
    int32_t texels = 0;
    std::memcpy(&texels, from + static_cast<uint32_t>(places[i]), sizeof(texels));
    return texels;
  };
  const auto half = [&](int i) {
    const __m128i left = _mm_insert_epi32(_mm_cvtsi32_si128(four(i)), four(i + 1), 1);
    const __m128i right = _mm_insert_epi32(_mm_cvtsi32_si128(four(i + 2)), four(i + 3), 1);
    return _mm_unpacklo_epi64(left, right);
  };
  return reinterpret_cast<I8>(_mm256_set_m128i(half(4), half(0)));
}
/// Returns the numbers at each position and to the right of it.
inline void gather(const float* from, I8 places, F8& here, F8& right) {
  const auto two = [&](int i, int k) {
    const __m128 first = _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from + places[i])));
    return _mm_loadh_pi(first, reinterpret_cast<const __m64*>(from + places[k]));
  };
  const __m256 a = _mm256_set_m128(two(4, 5), two(0, 1)), b = _mm256_set_m128(two(6, 7), two(2, 3));
  here = _mm256_shuffle_ps(a, b, _MM_SHUFFLE(2, 0, 2, 0));
  right = _mm256_shuffle_ps(a, b, _MM_SHUFFLE(3, 1, 3, 1));
}
/// Returns table[i] for each lane. @param i  0..15.
inline I8 look_up(const int32_t table[16], I8 i) {
  const __m256i at = reinterpret_cast<__m256i>(i);
#ifdef __AVX512VL__
  return reinterpret_cast<I8>(
      _mm256_permutex2var_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(table)), at,
                                _mm256_loadu_si256(reinterpret_cast<const __m256i*>(table + 8))));
#else
  const auto low = _mm256_permutevar8x32_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(table)), at);
  const auto high = _mm256_permutevar8x32_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(table + 8)), at);
  return pick(i > 7, reinterpret_cast<I8>(high), reinterpret_cast<I8>(low));
#endif
}
/// Orders of bytes that repeat the lowest byte of each lane at the bytes of its row and column weights.
inline __m128i bytes_for_rows() { return _mm_setr_epi8(0, 0, 0, 0, 4, 4, 4, 4, 8, 8, 8, 8, 12, 12, 12, 12); }
inline __m128i bytes_for_columns() { return _mm_setr_epi8(0, -1, 0, -1, 4, -1, 4, -1, 8, -1, 8, -1, 12, -1, 12, -1); }
/// Returns the weights 255 - b and b of rows or columns, b the lowest byte of a lane: 255 - b is ~b.
inline __m256i row_weights(I8 v) {
  const __m256i order = _mm256_broadcastsi128_si256(bytes_for_rows());
  return _mm256_shuffle_epi8(reinterpret_cast<__m256i>(v), order) ^ _mm256_set1_epi32(0x00ff00ff);
}
inline __m256i column_weights(I8 u) {
  const __m256i order = _mm256_broadcastsi128_si256(bytes_for_columns());
  return _mm256_shuffle_epi8(reinterpret_cast<__m256i>(u), order) ^ _mm256_set1_epi32(0x000000ff);
}
/// Returns the weighted sum of four texels, in units of 1/65025.
/// @param texels  minus 128, four bytes per lane: (left, upper), (left, lower), (right, upper), (right, lower).
/// @param u, v  their lowest bytes are the weights of the right and the lower texels.
inline I8 mix(I8 texels, I8 u, I8 v) {
  const __m256i columns = _mm256_maddubs_epi16(row_weights(v), reinterpret_cast<__m256i>(texels));
  return reinterpret_cast<I8>(_mm256_madd_epi16(columns, column_weights(u)));
}
/// The same for three channels.
/// @param texels  minus 128, four bytes each, the last one unused. The right neighbor follows each texel.
/// @param upper, lower  positions of the left texels. @param sums  output for each channel.
inline void mix(const uint32_t* texels, I8 upper, I8 lower, I8 u, I8 v, I8 (&sums)[3]) {
  const __m256i rows = row_weights(v), columns = column_weights(u);
  const auto two = [texels](int32_t above, int32_t below) {  // texels of each row
    const auto* const from = reinterpret_cast<const __m128i*>(texels + above);
    const __m128d left = _mm_castsi128_pd(_mm_loadl_epi64(from));
    return _mm_castpd_si128(_mm_loadh_pd(left, reinterpret_cast<const double*>(texels + below)));
  };
  // Puts the four texels of a channel next to each other.
  const __m256i order =
      _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 8, 4, 12, 1, 9, 5, 13, 2, 10, 6, 14, 3, 11, 7, 15));
  __m256i mixed[4];  // channels of lanes k and k + 4
  for (int k = 0; k < 4; ++k) {
    const __m256i lanes = _mm256_setr_epi32(k, k, k, k, k + 4, k + 4, k + 4, k + 4);
    const __m256i four =
        _mm256_shuffle_epi8(_mm256_set_m128i(two(upper[k + 4], lower[k + 4]), two(upper[k], lower[k])), order);
    mixed[k] = _mm256_madd_epi16(_mm256_maddubs_epi16(_mm256_permutevar8x32_epi32(rows, lanes), four),
                                 _mm256_permutevar8x32_epi32(columns, lanes));
  }
  const __m256i a = _mm256_unpacklo_epi32(mixed[0], mixed[1]), b = _mm256_unpacklo_epi32(mixed[2], mixed[3]);
  const __m256i c = _mm256_unpackhi_epi32(mixed[0], mixed[1]), d = _mm256_unpackhi_epi32(mixed[2], mixed[3]);
  sums[0] = reinterpret_cast<I8>(_mm256_unpacklo_epi64(a, b));
  sums[1] = reinterpret_cast<I8>(_mm256_unpackhi_epi64(a, b));
  sums[2] = reinterpret_cast<I8>(_mm256_unpacklo_epi64(c, d));
}
/// Returns the lanes as bytes, clamped to 0..255, lane 0 in the lowest byte.
inline uint64_t bytes(I8 a) {
  const auto words = _mm256_packs_epi32(reinterpret_cast<__m256i>(a), reinterpret_cast<__m256i>(a));
  const auto both = _mm256_permute4x64_epi64(words, 0x08);
  return static_cast<uint64_t>(_mm_cvtsi128_si64(_mm_packus_epi16(_mm256_castsi256_si128(both), _mm_setzero_si128())));
}

#else

inline constexpr const char* kLanes = "plain";

inline F8 minimum(F8 a, F8 b) { return pick(a < b, a, b); }
inline F8 maximum(F8 a, F8 b) { return pick(a > b, a, b); }
inline D4 minimum(D4 a, D4 b) { return pick(a < b, a, b); }
inline D4 maximum(D4 a, D4 b) { return pick(a > b, a, b); }
inline I8 minimum(I8 a, I8 b) { return pick(a < b, a, b); }
inline I8 maximum(I8 a, I8 b) { return pick(a > b, a, b); }
inline I8 integers(F8 a) {
  I8 result;
  for (int i = 0; i < 8; ++i) result[i] = static_cast<int32_t>(__builtin_nearbyintf(a[i]));
  return result;
}
inline F8 roots(F8 a) {
  F8 result;
  for (int i = 0; i < 8; ++i) result[i] = __builtin_sqrtf(a[i]);
  return result;
}
inline L4 times(L4 a, int32_t b) { return a * int64_t{b}; }
inline uint32_t signs(I8 a) {
  uint32_t result = 0;
  for (int i = 0; i < 8; ++i) result |= static_cast<uint32_t>(a[i] < 0) << i;
  return result;
}
inline uint32_t signs(L4 a) {
  uint32_t result = 0;
  for (int i = 0; i < 4; ++i) result |= static_cast<uint32_t>(a[i] < 0) << i;
  return result;
}
inline I8 gather(const uint16_t* from, const int32_t* places) {
  I8 result;
  for (int i = 0; i < 8; ++i) {
    int32_t four = 0;
    std::memcpy(&four, from + places[i], sizeof(four));
    result[i] = four;
  }
  return result;
}
inline void gather(const float* from, I8 places, F8& here, F8& right) {
  for (int i = 0; i < 8; ++i) {
    here[i] = from[places[i]];
    right[i] = from[places[i] + 1];
  }
}
inline I8 look_up(const int32_t table[16], I8 i) {
  I8 result;
  for (int k = 0; k < 8; ++k) result[k] = table[i[k]];
  return result;
}
inline I8 mix(I8 texels, I8 u, I8 v) {
  const I8 right = u & 255, down = v & 255;
  I8 result;
  for (int i = 0; i < 8; ++i) {
    int8_t t[4];
    const int32_t four = texels[i];
    std::memcpy(t, &four, sizeof(t));
    result[i] = (t[0] * (255 - down[i]) + t[1] * down[i]) * (255 - right[i]) +
                (t[2] * (255 - down[i]) + t[3] * down[i]) * right[i];
  }
  return result;
}
inline void mix(const uint32_t* texels, I8 upper, I8 lower, I8 u, I8 v, I8 (&sums)[3]) {
  const I8 right = u & 255, down = v & 255;
  for (int i = 0; i < 8; ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      const auto level = [&](int32_t at) { return static_cast<int8_t>(texels[at] >> 8 * channel); };
      sums[channel][i] = (level(upper[i]) * (255 - down[i]) + level(lower[i]) * down[i]) * (255 - right[i]) +
                         (level(upper[i] + 1) * (255 - down[i]) + level(lower[i] + 1) * down[i]) * right[i];
    }
  }
}
inline uint64_t bytes(I8 a) {
  uint64_t result = 0;
  for (int i = 0; i < 8; ++i) {
    result |= static_cast<uint64_t>(a[i] < 0 ? 0 : a[i] > 255 ? 255 : a[i]) << 8 * i;
  }
  return result;
}

#endif

/// Minimum and maximum of eight numbers.
struct FloatRange {
  float min, max;
};
inline FloatRange range(F8 a) {
  const auto folded = [](F8 b, auto pick) {
    b = pick(b, __builtin_shufflevector(b, b, 4, 5, 6, 7, 0, 1, 2, 3));
    b = pick(b, __builtin_shufflevector(b, b, 2, 3, 0, 1, 6, 7, 4, 5));
    return pick(b, __builtin_shufflevector(b, b, 1, 0, 3, 2, 5, 4, 7, 6))[0];
  };
  return {folded(a, [](F8 b, F8 c) { return minimum(b, c); }), folded(a, [](F8 b, F8 c) { return maximum(b, c); })};
}

/// Transposes four numbers of each of eight rows into four columns. @param four  member of a row with the numbers.
template <class Row>
inline void columns_of(const Row (&rows)[8], F4 Row::*four, F8 (&columns)[4]) {
  F8 pairs[4];  // rows i and i + 4
  for (int i = 0; i < 4; ++i) {
    pairs[i] = __builtin_shufflevector(rows[i].*four, rows[i + 4].*four, 0, 1, 2, 3, 4, 5, 6, 7);
  }
  const F8 a = __builtin_shufflevector(pairs[0], pairs[1], 0, 8, 1, 9, 4, 12, 5, 13);
  const F8 b = __builtin_shufflevector(pairs[2], pairs[3], 0, 8, 1, 9, 4, 12, 5, 13);
  const F8 c = __builtin_shufflevector(pairs[0], pairs[1], 2, 10, 3, 11, 6, 14, 7, 15);
  const F8 d = __builtin_shufflevector(pairs[2], pairs[3], 2, 10, 3, 11, 6, 14, 7, 15);
  columns[0] = __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
  columns[1] = __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
  columns[2] = __builtin_shufflevector(c, d, 0, 1, 8, 9, 4, 5, 12, 13);
  columns[3] = __builtin_shufflevector(c, d, 2, 3, 10, 11, 6, 7, 14, 15);
}

}  // namespace
}  // namespace hedgehop::sim::tiles
