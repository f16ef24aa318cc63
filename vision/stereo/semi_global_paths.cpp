#include "vision/stereo/semi_global_paths.h"

#include <algorithm>
#include <bit>

#include "vision/stereo/cost_lanes.h"

namespace hedgehop::vision::stereo {
namespace {

/// Where a path's costs lie.
struct Costs {
  explicit Costs(PathCosts& path) : first(path.at(0)), leasts(path.leasts.data()), stride(path.stride) {}
  int16_t* at(int pixel) const { return first + pixel * stride; }
  int16_t *first, *leasts;
  ptrdiff_t stride;
};

/// A pixel's costs along one path, as far as they come from those of the pixel before.
template <class Lanes>
struct Path {
  HEDGEHOP_INLINE Path(const int16_t* before, const Lanes& its_least_before, int16_t* next, const Lanes& its_step,
                       const Lanes& leap_cost)
      : from(before),
        to(next),
        step(its_step),
        least_before(its_least_before),
        leap(least_before + leap_cost),
        least_yet(all<Lanes>(INT16_MAX)) {}

  HEDGEHOP_INLINE Lanes go_on(int disparity, const Lanes& squares) {
    const int16_t* at = from + disparity;
    return go_on(disparity, squares, load<Lanes>(at - 1), load<Lanes>(at), load<Lanes>(at + 1));
  }

  /// Where the pixel before is the one just computed: the processor waits for numbers that were stored otherwise than
  /// they are loaded.
  HEDGEHOP_INLINE Lanes go_on_at_once(int disparity, const Lanes& squares) {
    const int16_t* at = from + disparity;
    const Lanes before = load<Lanes>(at - kLanes<Lanes>), here = load<Lanes>(at),
                behind = load<Lanes>(at + kLanes<Lanes>);
    return go_on(disparity, squares, one_before(before, here), here, one_behind(here, behind));
  }

  HEDGEHOP_INLINE Lanes go_on(int disparity, const Lanes& squares, const Lanes& below, const Lanes& same,
                              const Lanes& above) {
    const Lanes best = least(least(same, least(below, above) + step), leap);
    const Lanes cost = squares + (best - least_before);
    store(to + disparity, cost);
    least_yet = least(least_yet, cost);
    return cost;
  }

  const int16_t* from;
  int16_t* to;
  Lanes step, least_before, leap, least_yet;
};

template <class Lanes>
HEDGEHOP_INLINE void walk_right_by(const PathRow row, PathCosts& from_left, PathCosts& above, PathCosts& here,
                                   PathCosts& from_above_right) {
  const int disparities = row.disparities;
  const Costs lefts(from_left), aboves(above), heres(here), rights(from_above_right);
  const Lanes step = all<Lanes>(row.step_cost), leap = all<Lanes>(row.leap_cost);
  int16_t *squares = row.squares, *sums = row.sums;
  Lanes least_before{};
  for (int x = 0; x < row.width; ++x, squares += disparities, sums += disparities) {
    // From one square to the next, a column enters and one leaves; the first and the last are repeated.
    const int16_t* enters = row.columns + std::min(x + row.half, row.width - 1) * ptrdiff_t{disparities};
    const int16_t* leaves = row.columns + std::max(x - row.half - 1, 0) * ptrdiff_t{disparities};
    const int16_t* square_before = x == 0 ? row.square_before : squares - disparities;
    const int turn = x % 2;
    Path<Lanes> a(lefts.at(turn), least_before, lefts.at(1 - turn), step, leap),
        b(aboves.at(x), all<Lanes>(aboves.leasts[x]), heres.at(x), step, leap),
        c(rights.at(x + 1), all<Lanes>(rights.leasts[x + 1]), rights.at(x), step, leap);
    for (int d = 0; d < disparities; d += kLanes<Lanes>) {
      const Lanes square = load<Lanes>(square_before + d) + load<Lanes>(enters + d) - load<Lanes>(leaves + d);
      store(squares + d, square);
      const Lanes two = add_not_negative(a.go_on_at_once(d, square), b.go_on(d, square));
      store(sums + d, add_not_negative(two, c.go_on(d, square)));
    }
    const Lanes8 leasts = least_of_each(a.least_yet, b.least_yet, c.least_yet);
    least_before = first_in_all(leasts, least_before);
    heres.leasts[x] = leasts[1];
    rights.leasts[x] = leasts[2];
  }
}

/// floor((100 cost - 1) / (100 - uniqueness_percent)) by multiplying: what does not beat a cost as it must is no more.
struct NotBeaten {
  explicit NotBeaten(int uniqueness_percent)
      : reciprocal((uint64_t{1} << 32) / static_cast<uint64_t>(100 - uniqueness_percent) + 1) {}
  HEDGEHOP_INLINE int16_t by(int16_t cost) const {
    if (cost == 0) return -1;
    const uint64_t most = (static_cast<uint64_t>(100 * cost - 1) * reciprocal) >> 32;
    return static_cast<int16_t>(std::min(most, uint64_t{INT16_MAX}));
  }
  uint64_t reciprocal;
};

/// The last one of the least sums, and whether all that it does not beat lie beside it.
template <class Lanes>
HEDGEHOP_INLINE Winner choose(const int16_t* sums, int16_t cost, int16_t most_not_beaten, int disparities) {
  const Lanes cheapest = all<Lanes>(cost), not_beaten = all<Lanes>(most_not_beaten);
  constexpr int kBits = 64;
  int best = 0, last = 0, first = disparities;
  for (int begin = 0; begin < disparities; begin += kBits) {
    uint64_t equal = 0, rivals = 0;
    for (int d = begin; d < std::min(begin + kBits, disparities); d += kLanes<Lanes>) {
      const Lanes sum = load<Lanes>(sums + d);
      equal |= uint64_t{bits(sum == cheapest)} << (d - begin);
      rivals |= uint64_t{bits(sum <= not_beaten)} << (d - begin);
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
  const NotBeaten not_beaten(uniqueness_percent);
  const int16_t* squares = row.squares + static_cast<ptrdiff_t>(row.width) * disparities;
  int16_t* sums = row.sums + static_cast<ptrdiff_t>(row.width) * disparities;
  Lanes least_before{};
  for (int x = row.width - 1; x >= 0; --x) {
    squares -= disparities;
    sums -= disparities;
    const int turn = x % 2;
    Path<Lanes> a(rights.at(turn), least_before, rights.at(1 - turn), step, leap),
        b(lefts.at(x), all<Lanes>(lefts.leasts[x]), lefts.at(x + 1), step, leap);
    Lanes least_sums = all<Lanes>(INT16_MAX);
    for (int d = 0; d < disparities; d += kLanes<Lanes>) {
      const Lanes square = load<Lanes>(squares + d);
      const Lanes two = add_not_negative(a.go_on_at_once(d, square), b.go_on(d, square));
      const Lanes sum = add_not_negative(load<Lanes>(sums + d), two);
      store(sums + d, sum);
      least_sums = least(least_sums, sum);
    }
    const Lanes8 leasts = least_of_each(a.least_yet, b.least_yet, least_sums);
    least_before = first_in_all(leasts, least_before);
    lefts.leasts[x + 1] = leasts[1];
    winners[x] = choose<Lanes>(sums, leasts[2], not_beaten.by(leasts[2]), disparities);
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

// One of each pair is chosen as the program starts.
HEDGEHOP_TARGET_DEFAULT void walk_right_at_once(const PathRow& row, PathCosts& from_left, PathCosts& above,
                                                PathCosts& here, PathCosts& from_above_right) {
  walk_right_narrow(row, from_left, above, here, from_above_right);
}
HEDGEHOP_TARGET_DEFAULT void walk_left_at_once(const PathRow& row, PathCosts& from_right, PathCosts& from_above_left,
                                               int uniqueness_percent, Winner* winners) {
  walk_left_narrow(row, from_right, from_above_left, uniqueness_percent, winners);
}
#ifdef HEDGEHOP_HAS_AVX2
[[gnu::target("avx2")]] void walk_right_at_once(const PathRow& row, PathCosts& from_left, PathCosts& above,
                                                PathCosts& here, PathCosts& from_above_right) {
  walk_right_by<Lanes16>(row, from_left, above, here, from_above_right);
}
[[gnu::target("avx2")]] void walk_left_at_once(const PathRow& row, PathCosts& from_right, PathCosts& from_above_left,
                                               int uniqueness_percent, Winner* winners) {
  walk_left_by<Lanes16>(row, from_right, from_above_left, uniqueness_percent, winners);
}
#endif

}  // namespace

PathCosts::PathCosts(int pixels, int disparities)
    : stride(disparities + kRoom),
      costs(static_cast<size_t>(kRoom + pixels * stride), kFar),
      leasts(static_cast<size_t>(pixels), int16_t{0}) {
  clear();
}

void PathCosts::clear() {
  for (size_t pixel = 0; pixel < leasts.size(); ++pixel) {
    std::fill_n(at(static_cast<int>(pixel)), stride - kRoom, int16_t{0});
    leasts[pixel] = 0;
  }
}

void walk_right(const PathRow& row, PathCosts& from_left, PathCosts& above, PathCosts& here,
                PathCosts& from_above_right) {
  if (row.narrow) return walk_right_narrow(row, from_left, above, here, from_above_right);
  walk_right_at_once(row, from_left, above, here, from_above_right);
}

void walk_left(const PathRow& row, PathCosts& from_right, PathCosts& from_above_left, int uniqueness_percent,
               Winner* winners) {
  if (row.narrow) return walk_left_narrow(row, from_right, from_above_left, uniqueness_percent, winners);
  walk_left_at_once(row, from_right, from_above_left, uniqueness_percent, winners);
}

}  // namespace hedgehop::vision::stereo
