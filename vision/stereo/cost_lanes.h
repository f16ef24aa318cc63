#pragma once

#include <cstdint>
#include <cstring>
#include <opencv2/core/hal/intrin.hpp>

#include "vision/flow/wide_integers.h"

/// Whole numbers of 16 bits side by side, each computed for itself: what they come to does not depend on how many there
/// are. Eight fill a register of every processor, sixteen one of AVX2.
namespace hedgehop::vision::stereo {

using Lanes8 [[gnu::vector_size(16)]] = int16_t;
using Lanes16 [[gnu::vector_size(32)]] = int16_t;
template <class Lanes>
inline constexpr int kLanes = sizeof(Lanes) / sizeof(int16_t);

// All is inlined: no register is handed to a function that is compiled for other processors. GCC warns at the end of
// the file, hence for all of it.
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
HEDGEHOP_INLINE Lanes least(const Lanes& a, const Lanes& b) {
  return a < b ? a : b;
}
template <class Lanes>
HEDGEHOP_INLINE Lanes most(const Lanes& a, const Lanes& b) {
  return a > b ? a : b;
}

/// What lies one number before `here` in memory, and one behind, when what lies about it has been loaded.
HEDGEHOP_INLINE Lanes16 one_before(const Lanes16& before, const Lanes16& here) {
  return __builtin_shufflevector(before, here, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30);
}
HEDGEHOP_INLINE Lanes16 one_behind(const Lanes16& here, const Lanes16& behind) {
  return __builtin_shufflevector(here, behind, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16);
}
HEDGEHOP_INLINE Lanes8 one_before(const Lanes8& before, const Lanes8& here) {
  return __builtin_shufflevector(before, here, 7, 8, 9, 10, 11, 12, 13, 14);
}
HEDGEHOP_INLINE Lanes8 one_behind(const Lanes8& here, const Lanes8& behind) {
  return __builtin_shufflevector(here, behind, 1, 2, 3, 4, 5, 6, 7, 8);
}

/// The sum of numbers that are not negative; it stops at the largest number.
template <class Lanes>
HEDGEHOP_INLINE Lanes add_not_negative(const Lanes& a, const Lanes& b) {
  return b + least(a, Lanes(INT16_MAX - b));
}

/// The least number of each of three registers, in the first three lanes.
HEDGEHOP_INLINE Lanes8 least_of_each(const Lanes8& a, const Lanes8& b, const Lanes8& c) {
  // Halves of two registers side by side, then quarters of all.
  const auto pairs = [](const Lanes8& x, const Lanes8& y) __attribute__((always_inline)) {
    return least(Lanes8(__builtin_shufflevector(x, y, 0, 8, 1, 9, 2, 10, 3, 11)),
                 Lanes8(__builtin_shufflevector(x, y, 4, 12, 5, 13, 6, 14, 7, 15)));
  };
  const Lanes8 all = pairs(pairs(a, c), pairs(b, b));
  return least(all, Lanes8(__builtin_shufflevector(all, all, 4, 5, 6, 7, 4, 5, 6, 7)));
}
HEDGEHOP_INLINE Lanes8 least_of_each(const Lanes16& a, const Lanes16& b, const Lanes16& c) {
  const auto halved = [](const Lanes16& x) __attribute__((always_inline)) {
    return least(Lanes8(__builtin_shufflevector(x, x, 0, 1, 2, 3, 4, 5, 6, 7)),
                 Lanes8(__builtin_shufflevector(x, x, 8, 9, 10, 11, 12, 13, 14, 15)));
  };
  return least_of_each(halved(a), halved(b), halved(c));
}
/// The first number in all lanes.
HEDGEHOP_INLINE Lanes8 first_in_all(const Lanes8& from, const Lanes8&) {
  return __builtin_shufflevector(from, from, 0, 0, 0, 0, 0, 0, 0, 0);
}
HEDGEHOP_INLINE Lanes16 first_in_all(const Lanes8& from, const Lanes16&) {
  return __builtin_shufflevector(from, from, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0);
}

/// A bit for each number of what a comparison gave, the first one lowest.
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
