#include "vision/stereo/semi_global_paths.h"

#include <algorithm>
#include <bit>

#include "vision/stereo/cost_lanes.h"

namespace hedgehop::vision::stereo {
namespace {

/// Pointers to a path's costs.
struct Costs {
  explicit Costs(PathCosts& path) : first(path.at(0)), minima(path.minima.data()), stride(path.stride) {}
  int16_t* at(int pixel) const { return first + pixel * stride; }
  int16_t *first, *minima;
  ptrdiff_t stride;
};

/// Computes a pixel's costs along one path from those of the previous pixel.
template <class Lanes>
struct Path {
  HEDGEHOP_INLINE Path(const int16_t* before, const Lanes& its_min_before, int16_t* next, const Lanes& its_step,
                       const Lanes& leap_cost)
      : from(before),
        to(next),
        step(its_step),
        min_before(its_min_before),
        leap(min_before + leap_cost),
        minimum_so_far(all<Lanes>(INT16_MAX)) {}

  HEDGEHOP_INLINE Lanes advance(int disparity, const Lanes& squares) {
    const int16_t* at = from + disparity;
    return advance(disparity, squares, load<Lanes>(at - 1), load<Lanes>(at), load<Lanes>(at + 1));
  }

  /// For a previous pixel that was just computed: loads with the alignment of the stores, which avoids a stall of the
  /// processor.
  HEDGEHOP_INLINE Lanes advance_from_last(int disparity, const Lanes& squares) {
    const int16_t* at = from + disparity;
    const Lanes before = load<Lanes>(at - kLanes<Lanes>), here = load<Lanes>(at),
                after = load<Lanes>(at + kLanes<Lanes>);
    return advance(disparity, squares, one_before(before, here), here, one_after(here, after));
  }

  HEDGEHOP_INLINE Lanes advance(int disparity, const Lanes& squares, const Lanes& below, const Lanes& same,
                                const Lanes& above) {
    const Lanes best = minimum(minimum(same, minimum(below, above) + step), leap);
    const Lanes cost = squares + (best - min_before);
    store(to + disparity, cost);
    minimum_so_far = minimum(minimum_so_far, cost);
    return cost;
  }

  const int16_t* from;
  int16_t* to;
  Lanes step, min_before, leap, minimum_so_far;
};

template <class Lanes>
HEDGEHOP_INLINE void walk_right_by(const PathRow row, PathCosts& from_left, PathCosts& above, PathCosts& here,
                                   PathCosts& from_above_right) {
  const int disparities = row.disparities;
  const Costs lefts(from_left), aboves(above), heres(here), rights(from_above_right);
  const Lanes step = all<Lanes>(row.step_cost), leap = all<Lanes>(row.leap_cost);
  int16_t *squares = row.squares, *sums = row.sums;
  Lanes min_before{};
  for (int x = 0; x < row.width; ++x, squares += disparities, sums += disparities) {
    // From one block to the next, one column enters and one leaves. The first and last columns are repeated.
    const int16_t* enters = row.columns + std::min(x + row.half, row.width - 1) * ptrdiff_t{disparities};
    const int16_t* leaves = row.columns + std::max(x - row.half - 1, 0) * ptrdiff_t{disparities};
    const int16_t* square_before = x == 0 ? row.square_before : squares - disparities;
    const int turn = x % 2;
    Path<Lanes> a(lefts.at(turn), min_before, lefts.at(1 - turn), step, leap),
        b(aboves.at(x), all<Lanes>(aboves.minima[x]), heres.at(x), step, leap),
        c(rights.at(x + 1), all<Lanes>(rights.minima[x + 1]), rights.at(x), step, leap);
    for (int d = 0; d < disparities; d += kLanes<Lanes>) {
      const Lanes square = load<Lanes>(square_before + d) + load<Lanes>(enters + d) - load<Lanes>(leaves + d);
      store(squares + d, square);
      const Lanes two = add_saturated(a.advance_from_last(d, square), b.advance(d, square));
      store(sums + d, add_saturated(two, c.advance(d, square)));
    }
    const Lanes8 minima = minimum_of_each(a.minimum_so_far, b.minimum_so_far, c.minimum_so_far);
    min_before = first_in_all(minima, min_before);
    heres.minima[x] = minima[1];
    rights.minima[x] = minima[2];
  }
}

/// Threshold of the uniqueness test: floor((100 cost - 1) / (100 - uniqueness_percent)), computed by multiplication.
/// Sums up to it are rivals of the best sum.
struct RivalThreshold {
  explicit RivalThreshold(int uniqueness_percent)
      : reciprocal((uint64_t{1} << 32) / static_cast<uint64_t>(100 - uniqueness_percent) + 1) {}
  HEDGEHOP_INLINE int16_t of(int16_t cost) const {
    if (cost == 0) return -1;
    const uint64_t threshold = (static_cast<uint64_t>(100 * cost - 1) * reciprocal) >> 32;
    return static_cast<int16_t>(std::min(threshold, uint64_t{INT16_MAX}));
  }
  uint64_t reciprocal;
};

/// Returns the last one of the minimum sums, and whether all its rivals are adjacent to it.
template <class Lanes>
HEDGEHOP_INLINE Winner choose(const int16_t* sums, int16_t cost, int16_t rival_threshold, int disparities) {
  const Lanes cheapest = all<Lanes>(cost), threshold = all<Lanes>(rival_threshold);
  constexpr int kBits = 64;
  int best = 0, last = 0, first = disparities;
  for (int begin = 0; begin < disparities; begin += kBits) {
    uint64_t equal = 0, rivals = 0;
    for (int d = begin; d < std::min(begin + kBits, disparities); d += kLanes<Lanes>) {
      const Lanes sum = load<Lanes>(sums + d);
      equal |= uint64_t{bits(sum == cheapest)} << (d - begin);
      rivals |= uint64_t{bits(sum <= threshold)} << (d - begin);
    }
    if (equal != 0) best = begin + std::bit_width(equal) - 1;
    if (rivals == 0) continue;
    last = begin + std::bit_width(rivals) - 1;
    first = std::min(first, begin + std::countr_zero(rivals));
  }
  return {cost, static_cast<int16_t>(best), last <= best + 1 && first >= best - 1};
}

template <class Lanes>
HEDGEHOP_INLINE void walk_left_by(const PathRow row, PathCosts& from_right, PathCosts& from_above_left,
                                  int uniqueness_percent, Winner* winners) {
  const int disparities = row.disparities;
  const Costs rights(from_right), lefts(from_above_left);
  const Lanes step = all<Lanes>(row.step_cost), leap = all<Lanes>(row.leap_cost);
  const RivalThreshold rival_threshold(uniqueness_percent);
  const int16_t* squares = row.squares + static_cast<ptrdiff_t>(row.width) * disparities;
  int16_t* sums = row.sums + static_cast<ptrdiff_t>(row.width) * disparities;
  Lanes min_before{};
  for (int x = row.width - 1; x >= 0; --x) {
    squares -= disparities;
    sums -= disparities;
    const int turn = x % 2;
    Path<Lanes> a(rights.at(turn), min_before, rights.at(1 - turn), step, leap),
        b(lefts.at(x), all<Lanes>(lefts.minima[x]), lefts.at(x + 1), step, leap);
    Lanes min_sums = all<Lanes>(INT16_MAX);
    for (int d = 0; d < disparities; d += kLanes<Lanes>) {
      const Lanes square = load<Lanes>(squares + d);
      const Lanes two = add_saturated(a.advance_from_last(d, square), b.advance(d, square));
      const Lanes sum = add_saturated(load<Lanes>(sums + d), two);
      store(sums + d, sum);
      min_sums = minimum(min_sums, sum);
    }
    const Lanes8 minima = minimum_of_each(a.minimum_so_far, b.minimum_so_far, min_sums);
    min_before = first_in_all(minima, min_before);
    lefts.minima[x + 1] = minima[1];
    winners[x] = choose<Lanes>(sums, minima[2], rival_threshold.of(minima[2]), disparities);
  }
}

void walk_right_narrow(const PathRow& row, PathCosts& from_left, PathCosts& above, PathCosts& here,
                       PathCosts& from_above_right) {
  walk_right_by<Lanes8>(row, from_left, above, here, from_above_right);
}
void walk_left_narrow(const PathRow& row, PathCosts& from_right, PathCosts& from_above_left, int uniqueness_percent,
                      Winner* winners) {
  walk_left_by<Lanes8>(row, from_right, from_above_left, uniqueness_percent, winners);
}

// The version for the processor is selected at program start.
HEDGEHOP_TARGET_DEFAULT void walk_right_wide(const PathRow& row, PathCosts& from_left, PathCosts& above,
                                             PathCosts& here, PathCosts& from_above_right) {
  walk_right_narrow(row, from_left, above, here, from_above_right);
}
HEDGEHOP_TARGET_DEFAULT void walk_left_wide(const PathRow& row, PathCosts& from_right, PathCosts& from_above_left,
                                            int uniqueness_percent, Winner* winners) {
  walk_left_narrow(row, from_right, from_above_left, uniqueness_percent, winners);
}
#ifdef HEDGEHOP_HAS_AVX2
[[gnu::target("avx2")]] void walk_right_wide(const PathRow& row, PathCosts& from_left, PathCosts& above,
                                             PathCosts& here, PathCosts& from_above_right) {
  walk_right_by<Lanes16>(row, from_left, above, here, from_above_right);
}
[[gnu::target("avx2")]] void walk_left_wide(const PathRow& row, PathCosts& from_right, PathCosts& from_above_left,
                                            int uniqueness_percent, Winner* winners) {
  walk_left_by<Lanes16>(row, from_right, from_above_left, uniqueness_percent, winners);
}
#endif

}  // namespace

PathCosts::PathCosts(int pixels, int disparities)
    : stride(disparities + kPadding),
      costs(static_cast<size_t>(kPadding + pixels * stride), kFar),
      minima(static_cast<size_t>(pixels), int16_t{0}) {
  clear();
}

void PathCosts::clear() {
  for (size_t pixel = 0; pixel < minima.size(); ++pixel) {
    std::fill_n(at(static_cast<int>(pixel)), stride - kPadding, int16_t{0});
    minima[pixel] = 0;
  }
}

void walk_right(const PathRow& row, PathCosts& from_left, PathCosts& above, PathCosts& here,
                PathCosts& from_above_right) {
  if (row.narrow) return walk_right_narrow(row, from_left, above, here, from_above_right);
  walk_right_wide(row, from_left, above, here, from_above_right);
}

void walk_left(const PathRow& row, PathCosts& from_right, PathCosts& from_above_left, int uniqueness_percent,
               Winner* winners) {
  if (row.narrow) return walk_left_narrow(row, from_right, from_above_left, uniqueness_percent, winners);
  walk_left_wide(row, from_right, from_above_left, uniqueness_percent, winners);
}

}  // namespace hedgehop::vision::stereo
