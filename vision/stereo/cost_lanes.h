#pragma once

#include <cstdint>
#include <cstring>
#include <opencv2/core/hal/intrin.hpp>

#include "vision/flow/wide_integers.h"

// Vectors of 16-bit integers with element-wise operations, so that results do not depend on the vector length. Eight
// elements fill a register of every x86-64 processor, sixteen one of AVX2.
namespace hedgehop::vision::stereo {

using Lanes8 [[gnu::vector_size(16)]] = int16_t;
using Lanes16 [[gnu::vector_size(32)]] = int16_t;
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

/// Returns the values one position before (after) those of `here` in memory, from the adjacent vectors.
HEDGEHOP_INLINE Lanes16 one_before(const Lanes16& before, const Lanes16& here) {
  return __builtin_shufflevector(before, here, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30);
}
HEDGEHOP_INLINE Lanes16 one_after(const Lanes16& here, const Lanes16& after) {
  return __builtin_shufflevector(here, after, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16);
}
HEDGEHOP_INLINE Lanes8 one_before(const Lanes8& before, const Lanes8& here) {
  return __builtin_shufflevector(before, here, 7, 8, 9, 10, 11, 12, 13, 14);
}
HEDGEHOP_INLINE Lanes8 one_after(const Lanes8& here, const Lanes8& after) {
  return __builtin_shufflevector(here, after, 1, 2, 3, 4, 5, 6, 7, 8);
}

/// Returns the saturated sum of non-negative values.
template <class Lanes>
HEDGEHOP_INLINE Lanes add_saturated(const Lanes& a, const Lanes& b) {
  return b + minimum(a, Lanes(INT16_MAX - b));
}

/// Returns the minimum of each of three vectors, in the first three lanes.
HEDGEHOP_INLINE Lanes8 minimum_of_each(const Lanes8& a, const Lanes8& b, const Lanes8& c) {
  // Minimum over halves of two vectors, then over quarters of all.
  const auto pairs = [](const Lanes8& x, const Lanes8& y) __attribute__((always_inline)) {
    return minimum(Lanes8(__builtin_shufflevector(x, y, 0, 8, 1, 9, 2, 10, 3, 11)),
                   Lanes8(__builtin_shufflevector(x, y, 4, 12, 5, 13, 6, 14, 7, 15)));
  };
  const Lanes8 all = pairs(pairs(a, c), pairs(b, b));
  return minimum(all, Lanes8(__builtin_shufflevector(all, all, 4, 5, 6, 7, 4, 5, 6, 7)));
}
HEDGEHOP_INLINE Lanes8 minimum_of_each(const Lanes16& a, const Lanes16& b, const Lanes16& c) {
  const auto halved = [](const Lanes16& x) __attribute__((always_inline)) {
    return minimum(Lanes8(__builtin_shufflevector(x, x, 0, 1, 2, 3, 4, 5, 6, 7)),
                   Lanes8(__builtin_shufflevector(x, x, 8, 9, 10, 11, 12, 13, 14, 15)));
  };
  return minimum_of_each(halved(a), halved(b), halved(c));
}
/// Returns the first value in all lanes.
HEDGEHOP_INLINE Lanes8 first_in_all(const Lanes8& from, const Lanes8&) {
  return __builtin_shufflevector(from, from, 0, 0, 0, 0, 0, 0, 0, 0);
}
HEDGEHOP_INLINE Lanes16 first_in_all(const Lanes8& from, const Lanes16&) {
  return __builtin_shufflevector(from, from, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0);
}

/// Returns one bit per lane of a comparison's result, with the first lane in the lowest bit.
HEDGEHOP_INLINE unsigned bits(const Lanes8& low, const Lanes8& high) {
  return static_cast<unsigned>(cv::v_signmask(cv::v_pack(cv::v_load(reinterpret_cast<const int16_t*>(&low)),
                                                         cv::v_load(reinterpret_cast<const int16_t*>(&high)))));
}
HEDGEHOP_INLINE unsigned bits(const Lanes8& which) { return bits(which, which) & 255U; }
HEDGEHOP_INLINE unsigned bits(const Lanes16& which) {
  return bits(Lanes8(__builtin_shufflevector(which, which, 0, 1, 2, 3, 4, 5, 6, 7)),
              Lanes8(__builtin_shufflevector(which, which, 8, 9, 10, 11, 12, 13, 14, 15)));
}

}  // namespace hedgehop::vision::stereo
