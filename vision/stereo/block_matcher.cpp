#include "vision/stereo/block_matcher.h"

#include <algorithm>
#include <cstdlib>

#include "vision/flow/wide_integers.h"
#include "vision/stereo/cost_lanes.h"

namespace hedgehop::vision::stereo {
namespace {

constexpr int kMaxSum = 2 * kMaxSlope * BlockMatcher::kMaxBlockPx * BlockMatcher::kMaxBlockPx;
static_assert(kMaxSum <= INT16_MAX);
constexpr int kFoundBits = 16;  // of a match: below its cost, its disparity x 16
constexpr int kPartBits = 4, kPartsPerUnit = 1 << kPartBits, kPartsPerPixel = kPartsPerUnit * kUnitsPerPixel;

/// Slopes of one row of both images, beginning at the pixels compared at the maximum disparity.
struct SlopeRow {
  const uint8_t *left, *right;
};

/// Pointers for one row of blocks.
struct BlockRow {
  int width, disparities, half;
  int uniqueness_percent;
  SlopeRow enters, leaves;  ///< rows by which a block differs from that of the previous row
  int16_t *columns, *block;
  WinnerRow* winners;  ///< null: only the columns are required
};

/// Selects the best disparities of a row of blocks. @tparam kVectors  number of vectors of all disparities; 0: any.
template <class Lanes, int kVectors>
class BlockWalk {
 public:
  HEDGEHOP_INLINE explicit BlockWalk(const BlockRow& row) : row_(row), block_(row.block) {}

  HEDGEHOP_INLINE void sum_columns() const {
    for (int x = 0; x < row_.width; ++x) {
      for (int i = 0; i < vectors(); ++i) update(x, i);
    }
  }

  /// Columns left of the image are zero; the last column is repeated on the right.
  HEDGEHOP_INLINE void walk() {
    const int last = row_.width - 1, half = row_.half;
    for (int i = 0; i < vectors(); ++i) block_.set(i, Lanes{});
    for (int x = -half; x <= last; ++x) {
      for (int i = 0; i < vectors(); ++i) {
        Lanes sum = block_.at(i) + (x + half <= last ? update(x + half, i) : load<Lanes>(column(last, i)));
        if (x > half) sum -= load<Lanes>(column(x - half - 1, i));
        block_.set(i, sum);
      }
      if (x >= 0) row_.winners->set(x, best());
    }
  }

 private:
  HEDGEHOP_INLINE int vectors() const { return kVectors > 0 ? kVectors : row_.disparities / kLanes<Lanes>; }
  HEDGEHOP_INLINE int16_t* column(int x, int i) const {
    return row_.columns + (x * ptrdiff_t{vectors()} + i) * kLanes<Lanes>;
  }

  /// Updates the sums of a column to the current row.
  HEDGEHOP_INLINE Lanes update(int x, int i) const {
    const int d = i * kLanes<Lanes>;
    const Lanes sum = load<Lanes>(column(x, i)) + differences<Lanes>(row_.enters.left[x], row_.enters.right + x + d) -
                      differences<Lanes>(row_.leaves.left[x], row_.leaves.right + x + d);
    store(column(x, i), sum);
    return sum;
  }

  HEDGEHOP_INLINE Winner best() const {
    Lanes costs = block_.at(0);
    for (int i = 0; i < vectors(); ++i) {
      store(row_.block + i * kLanes<Lanes>, block_.at(i));
      costs = minimum(costs, block_.at(i));
    }
    const int16_t cost = nth<0>(minimum_of_each(costs, costs, costs, costs));
    const int threshold = row_.uniqueness_percent > 0 ? cost + cost * row_.uniqueness_percent / 100 : -1;
    return choose<Lanes, OfEqual::first>(row_.block, cost, static_cast<int16_t>(std::min(threshold, kMaxSum)),
                                         vectors() * kLanes<Lanes>);
  }

  const BlockRow row_;
  Costs<Lanes, kVectors> block_;
};

template <class Lanes, int kVectors>
HEDGEHOP_INLINE void walk_blocks(const BlockRow& row) {
  BlockWalk<Lanes, kVectors> walk(row);
  row.winners == nullptr ? walk.sum_columns() : walk.walk();
}
template <class Lanes>
HEDGEHOP_INLINE void match_row_by(const BlockRow& row) {
  switch (row.disparities / kLanes<Lanes>) {
    case 1:
      return walk_blocks<Lanes, 1>(row);
    case 2:
      return walk_blocks<Lanes, 2>(row);
    default:
      return walk_blocks<Lanes, 0>(row);
  }
}
HEDGEHOP_BY_LANES(match_row, match_row_by, BlockRow)

/// Computes the slopes of an image. As in OpenCV's block matcher, the rows next to the first and last one are repeated
/// beyond them, and the outermost columns and the last row of an odd number have zero slope.
void find_slopes(const cv::Mat& image, cv::Mat& slopes) {
  slopes.create(image.size(), CV_8UC1);
  for (int y = 0; y < image.rows; ++y) {
    auto* const to = slopes.ptr<uint8_t>(y);
    if (y + 1 == image.rows && image.rows % 2 == 1) {
      std::fill_n(to, image.cols, uint8_t{kMaxSlope});
      continue;
    }
    const int above = y > 0 ? y - 1 : 1, below = y + 1 < image.rows ? y + 1 : y - 1;
    row_slopes(image.ptr<uint8_t>(above), image.ptr<uint8_t>(y), image.ptr<uint8_t>(below), image.cols, to);
    to[0] = to[image.cols - 1] = kMaxSlope;
  }
}

HEDGEHOP_WIDE void replace_textures(const uint8_t* enters, const uint8_t* leaves, int count, int16_t* sums) {
  for (int x = 0; x < count; ++x) {
    sums[x] = static_cast<int16_t>(sums[x] + std::abs(enters[x] - kMaxSlope) - std::abs(leaves[x] - kMaxSlope));
  }
}

HEDGEHOP_WIDE void find_whole_disparities(const WinnerRow& winners, const int16_t* textures, int min_texture, int width,
                                          int disparities, int16_t* disparity16) {
  const int16_t *const at = winners.at(), *const unique = winners.unique();
  for (int x = 0; x < width; ++x) {
    const auto whole = static_cast<int16_t>((disparities - 1 - at[x]) * kUnitsPerPixel);
    disparity16[x] = (unique[x] & (textures[x] >= min_texture)) != 0 ? whole : kUnmatched;
  }
}

/// Computes the fractions of the disparities x 256, to be truncated; 0 at the ends and without a match.
HEDGEHOP_WIDE void find_parts(const WinnerRow& winners, const int16_t* disparity16, int width, int disparities,
                              int* dividends, int* divisors) {
  const int16_t *const at = winners.at(), *const costs = winners.costs(), *const before = winners.costs_before(),
                       *const after = winners.costs_after();
  for (int x = 0; x < width; ++x) {
    const int inside = (disparity16[x] >= 0) & (at[x] > 0) & (at[x] < disparities - 1), slope = after[x] - before[x];
    dividends[x] = slope * inside * kPartsPerPixel;
    divisors[x] = std::max(before[x] + after[x] - 2 * costs[x] + std::abs(slope), 1);
  }
}

}  // namespace

BlockMatcher::BlockMatcher(const BlockConfig& config, cv::Size size)
    : config_(config),
      width_(size.width - config.disparities_px),
      height_(size.height),
      no_slopes_(1, size.width, CV_8UC1, cv::Scalar(kMaxSlope)),
      columns_(static_cast<size_t>(width_) * static_cast<size_t>(config.disparities_px)),
      block_(static_cast<size_t>(config.disparities_px) + 2),
      column_textures_(static_cast<size_t>(width_ + config.block_px)),
      textures_(static_cast<size_t>(width_)),
      winners_(width_),
      dividends_(static_cast<size_t>(width_)),
      divisors_(dividends_),
      found_(static_cast<size_t>(width_)),
      right_matches_(static_cast<size_t>(size.width) + 1) {}  // one more for the disparity -1 of unmatched pixels

void BlockMatcher::compute(const cv::Mat& left, const cv::Mat& right, cv::Mat& disparity16) {
  disparity16.create(left.size(), CV_16SC1);
  disparity16.setTo(kUnmatched);
  if (height_ <= config_.block_px) return;
  find_slopes(left, left_);
  find_slopes(right, right_);
  for (auto* sums : {&columns_, &column_textures_}) std::fill(sums->begin(), sums->end(), int16_t{0});
  const int half = config_.block_px / 2, begin = half - 1, end = width_ - half;
  for (int y = 0; y < height_; ++y) {
    const bool whole = y >= 2 * half;  // the rows of a block
    add_row(y, whole);
    if (!whole || begin >= end) continue;
    choose_disparities();
    if (config_.left_right_px >= 0) check_right_consistency();
    std::copy(found_.begin() + std::max(begin, 0), found_.begin() + end,
              disparity16.ptr<int16_t>(y - half) + config_.disparities_px + std::max(begin, 0));
  }
}

/// Adds row y, and selects the best disparities of the blocks of which it is the last row, if they are whole.
void BlockMatcher::add_row(int y, bool whole) {
  const int disparities = config_.disparities_px, half = config_.block_px / 2, leaves = y - config_.block_px;
  const auto slopes = [&](int row) {
    // At the maximum disparity, the first column right of the margin corresponds to the second column of the right
    // image.
    const cv::Mat &l = row < 0 ? no_slopes_ : left_, &r = row < 0 ? no_slopes_ : right_;
    return SlopeRow{l.ptr<uint8_t>(std::max(row, 0)) + disparities, r.ptr<uint8_t>(std::max(row, 0)) + 1};
  };
  const BlockRow row{width_,
                     disparities,
                     half,
                     config_.uniqueness_percent,
                     slopes(y),
                     slopes(leaves),
                     columns_.data(),
                     block_.data() + 1,
                     whole ? &winners_ : nullptr};
  match_row(row, usable_lanes(config_.max_lanes, disparities));
  replace_textures(row.enters.left, row.leaves.left, width_, column_textures_.data() + half + 1);
}

/// Computes the disparity x 16 of each pixel in a row: the minimum of two lines of opposite slope through three costs.
/// Also matches the pixels of the right image.
void BlockMatcher::choose_disparities() {
  const int half = config_.block_px / 2, disparities = config_.disparities_px;
  int texture = 0;
  const int16_t* column = column_textures_.data() + half + 1;
  for (int x = 0; x < half; ++x) texture += column[x];
  for (int x = 0; x < width_; ++x) {
    texture += column[x + half] - column[x - half - 1];
    textures_[static_cast<size_t>(x)] = static_cast<int16_t>(texture);
  }
  find_whole_disparities(winners_, textures_.data(), config_.texture, width_, disparities, found_.data());
  find_parts(winners_, found_.data(), width_, disparities, dividends_.data(), divisors_.data());
  for (size_t x = 0; x < found_.size(); ++x) {
    // Truncated floats have the value of the integer division, because the dividend has at most 23 bits, the
    // quotient 7.
    const auto parts = static_cast<int>(static_cast<float>(dividends_[x]) / static_cast<float>(divisors_[x]));
    found_[x] = static_cast<int16_t>(found_[x] + ((parts + kPartsPerUnit - 1) >> kPartBits));
  }
  std::fill(right_matches_.begin(), right_matches_.end(), INT32_MAX);
  int* const matches = right_matches_.data() + disparities;
  for (int x = 0; x < width_; ++x) {
    // The cheapest match of the right pixel; of several, the one of the smallest disparity.
    const int found = found_[static_cast<size_t>(x)];
    int& match = matches[x - ((found + kUnitsPerPixel / 2) >> kUnitBits)];
    match = std::min(match, found >= 0 ? (winners_.costs()[x] << kFoundBits) + found : INT32_MAX);
  }
}

/// Removes disparities that contradict the match of the corresponding right pixel, at both adjacent integer
/// disparities.
void BlockMatcher::check_right_consistency() {
  const int* const matches = right_matches_.data() + config_.disparities_px;
  const int tolerance = config_.left_right_px * kUnitsPerPixel;
  const auto contradicts = [&](int x, int disparity, int found) {
    const int match = matches[x - disparity];
    return (match != INT32_MAX) & (std::abs(match % (1 << kFoundBits) - found) > tolerance);
  };
  for (int x = 0; x < width_; ++x) {
    int16_t& found = found_[static_cast<size_t>(x)];
    const int below = found >> kUnitBits, above = (found + kUnitsPerPixel - 1) >> kUnitBits;
    const bool wrong = contradicts(x, below, found) & contradicts(x, above, found);
    found = wrong ? kUnmatched : found;
  }
}

}  // namespace hedgehop::vision::stereo
