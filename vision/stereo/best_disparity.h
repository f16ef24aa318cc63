#pragma once

#include <algorithm>
#include <bit>
#include <vector>

#include "vision/stereo/cost_lanes.h"
#include "vision/stereo/disparity.h"

namespace hedgehop::vision::stereo {

// Of disparities x 16, as in vision/stereo/disparity.h.
inline constexpr int kUnitBits = 4, kUnitsPerPixel = 1 << kUnitBits;
static_assert(kUnitsPerPixel == kDisparityUnits);
inline constexpr int16_t kUnmatched = -kUnitsPerPixel;  ///< as OpenCV marks it

/// Costs of a pixel: in registers if their number is known, or in memory.
template <class Lanes, int kVectors>
class Costs {
 public:
  HEDGEHOP_INLINE explicit Costs(int16_t* memory) {
    for (int i = 0; i < kVectors; ++i) vectors_[i] = load<Lanes>(memory + i * kLanes<Lanes>);
  }
  HEDGEHOP_INLINE Lanes at(int i) const { return vectors_[i]; }
  HEDGEHOP_INLINE void set(int i, const Lanes& costs) { vectors_[i] = costs; }

 private:
  Lanes vectors_[kVectors];
};
template <class Lanes>
class Costs<Lanes, 0> {
 public:
  HEDGEHOP_INLINE explicit Costs(int16_t* memory) : memory_(memory) {}
  HEDGEHOP_INLINE Lanes at(int i) const { return load<Lanes>(memory_ + i * kLanes<Lanes>); }
  HEDGEHOP_INLINE void set(int i, const Lanes& costs) { store(memory_ + i * kLanes<Lanes>, costs); }

 private:
  int16_t* memory_;
};

/// Index of the best disparity of a pixel. Costs are in the order of disparities, largest first.
struct Winner {
  int16_t at;
  int16_t cost, cost_before, cost_after;  ///< its cost and the adjacent ones, which are undefined at the ends
  bool unique;
};

enum class OfEqual { first, last };

/// Selects the minimum cost. @param costs  the values before and after them must be readable. @param cost  their
/// minimum. @param rival_threshold  the winner is unique if no cost up to this is more than one disparity away.
template <class Lanes, OfEqual kOfEqual>
HEDGEHOP_INLINE Winner choose(const int16_t* costs, int16_t cost, int16_t rival_threshold, int disparities) {
  const Lanes cheapest = all<Lanes>(cost), threshold = all<Lanes>(rival_threshold);
  constexpr int kBits = 64;
  int best = -1, last = 0, first = disparities;
  for (int begin = 0; begin < disparities; begin += kBits) {
    uint64_t equals = 0, rivals = 0;
    for (int d = begin; d < std::min(begin + kBits, disparities); d += kLanes<Lanes>) {
      const Lanes some = load<Lanes>(costs + d);
      equals |= uint64_t{equal(some, cheapest)} << (d - begin);
      rivals |= uint64_t{at_most(some, threshold)} << (d - begin);
    }
    if (equals != 0 && (kOfEqual == OfEqual::last || best < 0)) {
      best = begin + (kOfEqual == OfEqual::last ? std::bit_width(equals) - 1 : std::countr_zero(equals));
    }
    if (rivals == 0) continue;
    last = begin + std::bit_width(rivals) - 1;
    first = std::min(first, begin + std::countr_zero(rivals));
  }
  const bool unique = (last <= best + 1) & (first >= best - 1);
  return {static_cast<int16_t>(best), cost, costs[best - 1], costs[best + 1], unique};
}

/// The winners of a row, as one array for each property.
class WinnerRow {
 public:
  explicit WinnerRow(int width) : width_(width), numbers_(5 * static_cast<size_t>(width)) {}
  HEDGEHOP_INLINE void set(int x, const Winner& winner) {
    int16_t* const to = numbers_.data() + x;
    to[0] = winner.at;
    to[width_] = winner.cost;
    to[2 * width_] = winner.cost_before;
    to[3 * width_] = winner.cost_after;
    to[4 * width_] = winner.unique;
  }
  const int16_t* at() const { return numbers_.data(); }
  const int16_t* costs() const { return numbers_.data() + width_; }
  const int16_t* costs_before() const { return numbers_.data() + 2 * width_; }
  const int16_t* costs_after() const { return numbers_.data() + 3 * width_; }
  const int16_t* unique() const { return numbers_.data() + 4 * width_; }  ///< 1 or 0

 private:
  ptrdiff_t width_;
  std::vector<int16_t> numbers_;
};

/// Returns the number of disparities to process at a time on this processor. @param max_lanes  8, 16 or 32.
inline int usable_lanes([[maybe_unused]] int max_lanes, [[maybe_unused]] int disparities) {
#ifdef HEDGEHOP_HAS_AVX2
  const bool avx512 = __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
  if (max_lanes >= 32 && disparities % 32 == 0 && avx512) return 32;
  if (max_lanes >= 16 && __builtin_cpu_supports("avx2")) return 16;
#endif
  return 8;
}

/// Defines `name`(row) with the version for the usable number of lanes, of which `body`<Lanes>(row) is the code.
#ifdef HEDGEHOP_HAS_AVX2
#define HEDGEHOP_BY_LANES(name, body, Row)                                                                 \
  void name##_by_8(const Row& row) { body<Lanes8>(row); }                                                  \
  [[gnu::target("avx2,bmi,lzcnt")]] void name##_by_16(const Row& row) { body<Lanes16>(row); }              \
  [[gnu::target("avx512bw,avx512vl,bmi,lzcnt")]] void name##_by_32(const Row& row) { body<Lanes32>(row); } \
  void name(const Row& row, int lanes) {                                                                   \
    return lanes == 32 ? name##_by_32(row) : lanes == 16 ? name##_by_16(row) : name##_by_8(row);           \
  }
#else
#define HEDGEHOP_BY_LANES(name, body, Row) \
  void name(const Row& row, int) { body<Lanes8>(row); }
#endif

}  // namespace hedgehop::vision::stereo
