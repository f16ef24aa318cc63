#pragma once

#include <cstdint>
#include <cstring>
#include <opencv2/core/hal/intrin.hpp>
#include <utility>

#include "vision/flow/wide_integers.h"
#ifdef HEDGEHOP_HAS_AVX2
#include <immintrin.h>
#endif

// Vectors of 16-bit integers with element-wise operations, so that results do not depend on the vector length. Eight
// elements fill a register of every x86-64 processor, sixteen one of AVX2, thirty-two one of AVX-512.
namespace hedgehop::vision::stereo {

using Lanes8 [[gnu::vector_size(16)]] = int16_t;
using Lanes16 [[gnu::vector_size(32)]] = int16_t;
using Lanes32 [[gnu::vector_size(64)]] = int16_t;
template <class Lanes>
inline constexpr int kLanes = sizeof(Lanes) / sizeof(int16_t);

// All functions are inlined, so that no register is passed to a function compiled for another processor. GCC reports
// this warning at the end of the file, so it is disabled for the complete file.
#pragma GCC diagnostic ignored "-Wpsabi"
#define HEDGEHOP_INLINE [[gnu::always_inline]] inline

template <class Lanes>
HEDGEHOP_INLINE Lanes load(const int16_t* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
/// As many 8-bit values.
template <class Lanes>
using Bytes [[gnu::vector_size(sizeof(Lanes) / 2)]] = uint8_t;
template <class Lanes>
HEDGEHOP_INLINE Lanes widen(const Bytes<Lanes>& bytes) {
  return __builtin_convertvector(bytes, Lanes);
}
template <class Lanes>
HEDGEHOP_INLINE Lanes load_bytes(const uint8_t* from) {
  Bytes<Lanes> bytes;
  std::memcpy(&bytes, from, sizeof bytes);
  return widen<Lanes>(bytes);
}
/// Returns the absolute differences of a value from several others.
template <class Lanes>
HEDGEHOP_INLINE Lanes differences(uint8_t one, const uint8_t* others) {
  uint8_t ones[kLanes<Lanes>];
  for (uint8_t& each : ones) each = one;
  Bytes<Lanes> a, b;
  std::memcpy(&a, ones, sizeof a);
  std::memcpy(&b, others, sizeof b);
  return widen<Lanes>((a > b ? a : b) - (a < b ? a : b));
}
template <class Lanes>
HEDGEHOP_INLINE void store(int16_t* to, const Lanes& lanes) {
  std::memcpy(to, &lanes, sizeof lanes);
}
template <class Lanes>
HEDGEHOP_INLINE Lanes all(int16_t number) {
  int16_t numbers[kLanes<Lanes>];
  for (int16_t& each : numbers) each = number;
  return load<Lanes>(numbers);
}
template <class Lanes>
HEDGEHOP_INLINE Lanes minimum(const Lanes& a, const Lanes& b) {
  return a < b ? a : b;
}

/// Returns the lanes of `a` and `b` whose indices kIndex(0), kIndex(1), ... returns; those of `b` follow those of `a`.
template <auto kIndex, class Lanes, int... kLane>
HEDGEHOP_INLINE auto shuffle(const Lanes& a, const Lanes& b, std::integer_sequence<int, kLane...>) {
  return __builtin_shufflevector(a, b, kIndex(kLane, kLanes<Lanes>)...);
}
template <auto kIndex, int kCount = 0, class Lanes>
HEDGEHOP_INLINE auto shuffle(const Lanes& a, const Lanes& b) {
  return shuffle<kIndex>(a, b, std::make_integer_sequence < int, kCount == 0 ? kLanes<Lanes> : kCount > ());
}

/// Returns the values one position before (after) those of `here` in memory, from the adjacent vectors.
template <class Lanes>
HEDGEHOP_INLINE Lanes one_before(const Lanes& before, const Lanes& here) {
  return shuffle<[](int lane, int lanes) { return lane + lanes - 1; }>(before, here);
}
template <class Lanes>
HEDGEHOP_INLINE Lanes one_after(const Lanes& here, const Lanes& after) {
  return shuffle<[](int lane, int) { return lane + 1; }>(here, after);
}
// The compiler does not find these instructions of all x86-64 processors.
template <int kFirst>
HEDGEHOP_INLINE Lanes8 extract(const Lanes8& low, const Lanes8& high) {
  Lanes8 lanes;
  cv::v_store(reinterpret_cast<int16_t*>(&lanes),
              cv::v_extract<kFirst>(cv::v_load(reinterpret_cast<const int16_t*>(&low)),
                                    cv::v_load(reinterpret_cast<const int16_t*>(&high))));
  return lanes;
}
HEDGEHOP_INLINE Lanes8 one_before(const Lanes8& before, const Lanes8& here) { return extract<7>(before, here); }
HEDGEHOP_INLINE Lanes8 one_after(const Lanes8& here, const Lanes8& after) { return extract<1>(here, after); }

/// The same, with the next-but-one value beyond the ends, of which one_after() and one_before() have the same minimum.
template <class Lanes>
HEDGEHOP_INLINE Lanes one_before(const Lanes& here) {
  return shuffle<[](int lane, int) { return lane == 0 ? 1 : lane - 1; }>(here, here);
}
template <class Lanes>
HEDGEHOP_INLINE Lanes one_after(const Lanes& here) {
  return shuffle<[](int lane, int lanes) { return lane == lanes - 1 ? lane - 1 : lane + 1; }>(here, here);
}

/// Returns the sum of values >= 0, at most INT16_MAX.
template <class Lanes>
HEDGEHOP_INLINE Lanes add_saturated(const Lanes& a, const Lanes& b) {
  return b + minimum(a, Lanes(INT16_MAX - b));
}

/// Returns one bit per lane of a comparison's result, with the first lane in the lowest bit.
HEDGEHOP_INLINE unsigned bits(const Lanes8& low, const Lanes8& high) {
  return static_cast<unsigned>(cv::v_signmask(cv::v_pack(cv::v_load(reinterpret_cast<const int16_t*>(&low)),
                                                         cv::v_load(reinterpret_cast<const int16_t*>(&high)))));
}
HEDGEHOP_INLINE unsigned bits(const Lanes8& which) { return bits(which, which) & 255U; }
HEDGEHOP_INLINE unsigned bits(const Lanes16& which) {
  return bits(shuffle<[](int lane, int) { return lane; }, 8>(which, which),
              shuffle<[](int lane, int) { return lane + 8; }, 8>(which, which));
}
template <class Lanes>
HEDGEHOP_INLINE unsigned equal(const Lanes& a, const Lanes& b) {
  return bits(a == b);
}
template <class Lanes>
HEDGEHOP_INLINE unsigned at_most(const Lanes& a, const Lanes& b) {
  return bits(a <= b);
}

#ifdef HEDGEHOP_HAS_AVX2
// Instructions that the compiler does not derive from the vector operations above.
HEDGEHOP_INLINE Lanes16 add_saturated(const Lanes16& a, const Lanes16& b) { return __builtin_ia32_paddsw256(a, b); }
template <>
HEDGEHOP_INLINE Lanes32 widen<Lanes32>(const Bytes<Lanes32>& bytes) {
  using Chars [[gnu::vector_size(sizeof bytes)]] = char;
  return __builtin_ia32_pmovzxbw512_mask(reinterpret_cast<const Chars&>(bytes), Lanes32{}, ~0U);
}
HEDGEHOP_INLINE Lanes32 add_saturated(const Lanes32& a, const Lanes32& b) {
  return __builtin_ia32_paddsw512_mask(a, b, a, ~0U);
}
HEDGEHOP_INLINE unsigned equal(const Lanes32& a, const Lanes32& b) {
  return __builtin_ia32_cmpw512_mask(a, b, _MM_CMPINT_EQ, ~0U);
}
HEDGEHOP_INLINE unsigned at_most(const Lanes32& a, const Lanes32& b) {
  return __builtin_ia32_cmpw512_mask(a, b, _MM_CMPINT_LE, ~0U);
}
#endif

/// Returns the minimum of each of four vectors, for nth_in_all().
template <class Lanes>
HEDGEHOP_INLINE Lanes minimum_of_each(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& d) {
  // Within groups of eight lanes: the minimum over halves of two vectors, then over quarters and eighths of all.
  const auto pairs = [](const Lanes& x, const Lanes& y) __attribute__((always_inline)) {
    constexpr auto kLow = [](int lane, int lanes) { return lane / 8 * 8 + lane % 8 / 2 + lane % 2 * lanes; };
    constexpr auto kHigh = [](int lane, int lanes) { return lane / 8 * 8 + 4 + lane % 8 / 2 + lane % 2 * lanes; };
    return minimum(Lanes(shuffle<kLow>(x, y)), Lanes(shuffle<kHigh>(x, y)));
  };
  Lanes each = pairs(pairs(a, c), pairs(b, d));
  each = pairs(each, each);
  // Over the groups.
  const auto exchange = [&](auto index) __attribute__((always_inline)) {
    each = minimum(each, Lanes(shuffle<index>(each, each)));
  };
  if constexpr (kLanes < Lanes >> 16) exchange([](int lane, int) { return lane ^ 16; });
  if constexpr (kLanes < Lanes >> 8) exchange([](int lane, int) { return lane ^ 8; });
  return each;
}
/// Returns the result of minimum_of_each() for vector `kNth` in all lanes, or in one.
template <int kNth, class Lanes>
HEDGEHOP_INLINE Lanes nth_in_all(const Lanes& minima) {
  return shuffle<[](int lane, int) { return lane / 8 * 8 + 2 * kNth; }>(minima, minima);
}
template <int kNth, class Lanes>
HEDGEHOP_INLINE int16_t nth(const Lanes& minima) {
  return minima[2 * kNth];
}

/// Slopes are limited to +-kMaxSlope and stored as slope + kMaxSlope.
inline constexpr int kMaxSlope = 31;

/// Computes the slopes of brightness along a row, except at its ends: differences over two pixels, weighted 1 2 1 over
/// three rows. @param slopes  `width` values.
void row_slopes(const uint8_t* above, const uint8_t* here, const uint8_t* below, int width, uint8_t* slopes);

}  // namespace hedgehop::vision::stereo
