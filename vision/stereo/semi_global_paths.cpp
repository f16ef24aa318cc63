#include "vision/stereo/semi_global_paths.h"

#include <algorithm>

namespace hedgehop::vision::stereo {
namespace {

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

/// Pointers to the costs of a row.
struct Row {
  int width, disparities, half;
  int16_t step_cost, leap_cost;
  RivalThreshold rival_threshold;
  const uint8_t *enters, *leaves;
  int16_t *pixels, *columns, *last_left, *last_right;
  WinnerRow* winners;
};

/// Computes a pixel's costs along one path from those of the previous pixel.
template <class Lanes, int kVectors>
class Path {
 public:
  using PixelCosts = Costs<Lanes, kVectors>;

  /// @param to  may be `from`. @param leap  maximum cost before the pixel's own is added. @param subtrahend  of all
  /// costs.
  HEDGEHOP_INLINE Path(const PixelCosts& from, const PixelCosts& to, const Lanes& step_cost, const Lanes& leap,
                       const Lanes& subtrahend)
      : from_(from),
        to_(to),
        before_(all<Lanes>(PathCosts::kFar)),
        here_(from.at(0)),
        step_cost_(step_cost),
        leap_(leap),
        subtrahend_(subtrahend) {}

  /// Returns the costs of vector i, the next one.
  HEDGEHOP_INLINE Lanes advance(int i, bool last, const Lanes& block) {
    const Lanes after = last ? all<Lanes>(PathCosts::kFar) : from_.at(i + 1);
    const Lanes adjacent = kVectors == 1 ? minimum(one_before(here_), one_after(here_))
                                         : minimum(one_before(before_, here_), one_after(here_, after));
    // The minimum of the previous pixel is known last.
    const Lanes cost = (block - subtrahend_) + minimum(minimum(here_, Lanes(adjacent + step_cost_)), leap_);
    to_.set(i, cost);
    minimum_ = i == 0 ? cost : minimum(minimum_, cost);
    before_ = here_;
    here_ = after;
    return cost;
  }
  HEDGEHOP_INLINE const Lanes& minimum_so_far() const { return minimum_; }
  HEDGEHOP_INLINE const PixelCosts& costs() const { return to_; }

 private:
  PixelCosts from_, to_;
  Lanes before_, here_, step_cost_, leap_, subtrahend_, minimum_{};
};

/// Order of the two visits of a pixel. The second one selects the disparity.
enum class Visit { first, second };

/// Walks along a row in both directions at a time: each pixel's costs on a path depend on those of the previous one, so
/// the processor would wait on a single path.
/// @tparam kVectors  number of vectors of all disparities; 0: any.
template <class Lanes, int kVectors>
class RowWalk {
 public:
  using Kind = PathCosts::Kind;
  using enum PathCosts::Kind;

  HEDGEHOP_INLINE explicit RowWalk(const Row& row)
      : row_(row),
        step_cost_(all<Lanes>(row.step_cost)),
        leap_cost_(all<Lanes>(row.leap_cost)),
        left_(row.last_left),
        right_(row.last_right) {}

  /// Sums pixels to columns and these to blocks. The first and last columns are repeated.
  HEDGEHOP_INLINE void sum_blocks() {
    for (int d = 0; d < disparities(); d += kLanes<Lanes>) {
      const auto column = [&](int x) __attribute__((always_inline)) {
        return load<Lanes>(row_.columns + x * ptrdiff_t{disparities()} + d);
      };
      const auto update = [&](int x) __attribute__((always_inline)) {
        const ptrdiff_t i = x * ptrdiff_t{disparities()} + d;
        const Lanes sum =
            load<Lanes>(row_.columns + i) + load_bytes<Lanes>(row_.enters + i) - load_bytes<Lanes>(row_.leaves + i);
        store(row_.columns + i, sum);
        return sum;
      };
      const int last = row_.width - 1;
      for (int x = 0; x < std::min(row_.half, row_.width); ++x) update(x);
      Lanes sum{};
      for (int x = -row_.half; x < row_.half; ++x) sum += column(std::clamp(x, 0, last));
      for (int x = 0; x <= last; ++x) {
        sum += x + row_.half <= last ? update(x + row_.half) : column(last);
        store(at(x, kBlock) + d, sum);
        sum -= column(std::max(x - row_.half, 0));
      }
    }
  }

  HEDGEHOP_INLINE void walk() {
    for (int i = 0; i < vectors(); ++i) {
      left_.set(i, Lanes{});
      right_.set(i, Lanes{});
    }
    const int last = row_.width - 1;
    int x = 0;
    for (; x < last - x; ++x) {
      to_right<Visit::first>(x);
      to_left<Visit::first>(last - x);
    }
    if (x == last - x) {
      to_right<Visit::first>(x);
      to_left<Visit::second>(x++);
    }
    for (; x <= last; ++x) {
      to_right<Visit::second>(x);
      to_left<Visit::second>(last - x);
    }
  }

 private:
  HEDGEHOP_INLINE int vectors() const { return kVectors > 0 ? kVectors : row_.disparities / kLanes<Lanes>; }
  HEDGEHOP_INLINE int disparities() const { return vectors() * kLanes<Lanes>; }
  HEDGEHOP_INLINE int16_t* at(int x, Kind kind) const {
    return row_.pixels + (x * ptrdiff_t{kKinds} + kind) * disparities();
  }

  /// The path from the previous pixel of the row.
  HEDGEHOP_INLINE Path<Lanes, kVectors> path_along(const Costs<Lanes, kVectors>& last, const Lanes& min_cost) const {
    return {last, last, step_cost_, min_cost + leap_cost_, min_cost};
  }
  /// A path from the row above, whose costs are stored minus their minimum.
  HEDGEHOP_INLINE Path<Lanes, kVectors> path_down(int16_t* from, int16_t* to) const {
    return {Costs<Lanes, kVectors>(from), Costs<Lanes, kVectors>(to), step_cost_, leap_cost_, Lanes{}};
  }
  HEDGEHOP_INLINE void store_path_down(const Path<Lanes, kVectors>& path, const Lanes& min_cost, int16_t* to) const {
    for (int i = 0; i < vectors(); ++i) store(to + i * kLanes<Lanes>, Lanes(path.costs().at(i) - min_cost));
  }

  /// Adds costs to the sums of a pixel. @param costs  function of a vector's index, whether it is the last one, and the
  /// costs of the block. @return minimum sums.
  template <Visit kVisit, class Function>
  HEDGEHOP_INLINE Lanes add_to_sums(int x, const Function& costs) const {
    Lanes min_sums{};
    for (int i = 0; i < vectors(); ++i) {
      const int d = i * kLanes<Lanes>;
      Lanes sum = costs(i, i + 1 == vectors(), load<Lanes>(at(x, kBlock) + d));
      if constexpr (kVisit == Visit::second) sum = add_saturated(sum, load<Lanes>(at(x, kSum) + d));
      store(at(x, kSum) + d, sum);
      min_sums = i == 0 ? sum : minimum(min_sums, sum);
    }
    return min_sums;
  }

  /// Adds the paths from the left, from above and from the upper right.
  template <Visit kVisit>
  HEDGEHOP_INLINE void to_right(int x) {
    auto a = path_along(left_, min_left_), b = path_down(at(x, kAbove), at(x, kAbove)),
         c = path_down(at(x + 1, kAboveRight), at(x, kAboveRight));
    const Lanes min_sums = add_to_sums<kVisit>(
        x, [&](int i, bool last, const Lanes& block) __attribute__((always_inline)) {
          const Lanes two = add_saturated(a.advance(i, last, block), b.advance(i, last, block));
          return add_saturated(two, c.advance(i, last, block));
        });
    const Lanes minima = minimum_of_each(a.minimum_so_far(), b.minimum_so_far(), c.minimum_so_far(), min_sums);
    left_ = a.costs();
    min_left_ = nth_in_all<0>(minima);
    store_path_down(b, nth_in_all<1>(minima), at(x, kAbove));
    store_path_down(c, nth_in_all<2>(minima), at(x, kAboveRight));
    if constexpr (kVisit == Visit::second) choose_at(x, nth<3>(minima));
  }

  /// Adds the paths from the right and from the upper left.
  template <Visit kVisit>
  HEDGEHOP_INLINE void to_left(int x) {
    auto a = path_along(right_, min_right_), b = path_down(at(x - 1, kAboveLeft), at(x, kAboveLeft));
    const Lanes min_sums = add_to_sums<kVisit>(
        x, [&](int i, bool last, const Lanes& block) __attribute__((always_inline)) {
          return add_saturated(a.advance(i, last, block), b.advance(i, last, block));
        });
    const Lanes minima = minimum_of_each(a.minimum_so_far(), b.minimum_so_far(), min_sums, min_sums);
    right_ = a.costs();
    min_right_ = nth_in_all<0>(minima);
    store_path_down(b, nth_in_all<1>(minima), at(x, kAboveLeft));
    if constexpr (kVisit == Visit::second) choose_at(x, nth<2>(minima));
  }

  HEDGEHOP_INLINE void choose_at(int x, int16_t cost) const {
    row_.winners->set(x, choose<Lanes, OfEqual::last>(at(x, kSum), cost, row_.rival_threshold.of(cost), disparities()));
  }

  const Row row_;
  Lanes step_cost_, leap_cost_;
  Costs<Lanes, kVectors> left_, right_;  ///< of the previous pixels
  Lanes min_left_{}, min_right_{};       ///< their minima
};

template <class Lanes, int kVectors>
HEDGEHOP_INLINE void walk(const Row& row) {
  RowWalk<Lanes, kVectors> walk(row);
  walk.sum_blocks();
  walk.walk();
}

template <class Lanes>
HEDGEHOP_INLINE void add_row_by(const Row& row) {
  switch (row.disparities / kLanes<Lanes>) {
    case 1:
      return walk<Lanes, 1>(row);
    case 2:
      return walk<Lanes, 2>(row);
    default:
      return walk<Lanes, 0>(row);
  }
}
HEDGEHOP_BY_LANES(add_row_to, add_row_by, Row)

}  // namespace

PathCosts::PathCosts(const PathConfig& config)
    : config_(config),
      columns_(static_cast<size_t>(config.width) * static_cast<size_t>(config.disparities)),
      last_left_(static_cast<size_t>(config.disparities)),
      last_right_(last_left_),
      winners_(config.width) {
  const size_t count = (static_cast<size_t>(config.width) + 2) * kKinds * static_cast<size_t>(config.disparities);
  pixels_.resize((count + kLanes<Lanes32> - 1) / kLanes<Lanes32>);
}

void PathCosts::begin(const std::vector<int16_t>& columns) {
  columns_ = columns;
  std::fill(pixels_.begin(), pixels_.end(), CostLine{});
}

void PathCosts::add_row(const uint8_t* enters, const uint8_t* leaves) {
  const Row row{config_.width,
                config_.disparities,
                config_.half,
                config_.step_cost,
                config_.leap_cost,
                RivalThreshold(config_.uniqueness_percent),
                enters,
                leaves,
                pixels_.front().costs + ptrdiff_t{kKinds} * config_.disparities,
                columns_.data(),
                last_left_.data(),
                last_right_.data(),
                &winners_};
  add_row_to(row, usable_lanes(config_.max_lanes, config_.disparities));
}

}  // namespace hedgehop::vision::stereo
