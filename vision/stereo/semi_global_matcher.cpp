#include "vision/stereo/semi_global_matcher.h"

#include <algorithm>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

#include "vision/flow/wide_integers.h"
#include "vision/stereo/cost_lanes.h"

namespace hedgehop::vision::stereo {

namespace {

constexpr int kBrightnessShift = 2;  // weight of brightness relative to slope: 1/4

uint8_t excess(uint8_t a, uint8_t b) { return static_cast<uint8_t>(std::max(a, b) - b); }

HEDGEHOP_WIDE void find_line_extrema(const uint8_t* at, int width, uint8_t* low, uint8_t* high) {
  for (int x = 1; x < width - 1; ++x) {
    const auto before = static_cast<uint8_t>((at[x] + at[x - 1]) / 2);
    const auto after = static_cast<uint8_t>((at[x] + at[x + 1]) / 2);
    low[x] = std::min(at[x], std::min(before, after));
    high[x] = std::max(at[x], std::max(before, after));
  }
}

/// Value of a pixel and its range within half a pixel.
struct Pixel {
  uint8_t at, low, high;
  /// Returns the difference to another pixel: the distance of one pixel's value from the other's range, whichever is
  /// smaller.
  uint8_t difference(uint8_t other, uint8_t other_low, uint8_t other_high) const {
    const auto mine = static_cast<uint8_t>(excess(at, other_high) + excess(other_low, at));
    const auto theirs = static_cast<uint8_t>(excess(other, high) + excess(low, other));
    return std::min(mine, theirs);
  }
};

struct Pointers {
  const uint8_t *at, *low, *high;
  Pointers operator+(int columns) const { return {at + columns, low + columns, high + columns}; }
};

struct LinePair {
  Pointers left, right;
};

template <int kTogether>
[[gnu::always_inline]] inline void compare(const LinePair& slopes, const LinePair& brightnesses, int count,
                                           int disparities, uint8_t* __restrict costs) {
  for (int x = 0; x < count; ++x) {
    const Pixel slope{slopes.left.at[x], slopes.left.low[x], slopes.left.high[x]};
    const Pixel brightness{brightnesses.left.at[x], brightnesses.left.low[x], brightnesses.left.high[x]};
    for (int begin = 0; begin < disparities; begin += kTogether) {
      const Pointers s = slopes.right + (x + begin), b = brightnesses.right + (x + begin);
      uint8_t* cost = costs + static_cast<ptrdiff_t>(x) * disparities + begin;
      for (int i = 0; i < kTogether; ++i) {
        cost[i] = static_cast<uint8_t>(slope.difference(s.at[i], s.low[i], s.high[i]) +
                                       (brightness.difference(b.at[i], b.low[i], b.high[i]) >> kBrightnessShift));
      }
    }
  }
}
HEDGEHOP_WIDE void compare_by_16(const LinePair& slopes, const LinePair& brightnesses, int count, int disparities,
                                 uint8_t* costs) {
  compare<16>(slopes, brightnesses, count, disparities, costs);
}
HEDGEHOP_WIDE void compare_by_32(const LinePair& slopes, const LinePair& brightnesses, int count, int disparities,
                                 uint8_t* costs) {
  compare<32>(slopes, brightnesses, count, disparities, costs);
}

}  // namespace

HEDGEHOP_WIDE void row_slopes(const uint8_t* above, const uint8_t* here, const uint8_t* below, int width,
                              uint8_t* slopes) {
  for (int x = 1; x < width - 1; ++x) {
    const auto slope = static_cast<int16_t>((here[x + 1] - here[x - 1]) * 2 + above[x + 1] - above[x - 1] +
                                            below[x + 1] - below[x - 1]);
    slopes[x] = static_cast<uint8_t>(std::clamp<int16_t>(slope, -kMaxSlope, kMaxSlope) + kMaxSlope);
  }
}

PixelCosts::PixelCosts(int width_px, int disparities_px)
    : disparities_(disparities_px),
      left_{PixelLine(width_px), PixelLine(width_px)},
      right_{PixelLine(width_px), PixelLine(width_px)} {}

void PixelCosts::PixelLine::find_extrema() {
  const auto width = static_cast<int>(at.size());
  find_line_extrema(at.data(), width, low.data(), high.data());
  // The end pixels have one neighbor only.
  const auto end = [&](size_t x, size_t inner) {
    const auto between = static_cast<uint8_t>((at[x] + at[inner]) / 2);
    low[x] = std::min(at[x], between);
    high[x] = std::max(at[x], between);
  };
  end(0, 1);
  end(at.size() - 1, at.size() - 2);
}

void PixelCosts::read(const cv::Mat& image, int y, PixelLines& lines) {
  auto& [slope, brightness] = lines;
  const auto* const here = image.ptr<uint8_t>(y);
  row_slopes(image.ptr<uint8_t>(std::max(y - 1, 0)), here, image.ptr<uint8_t>(std::min(y + 1, image.rows - 1)),
             image.cols, slope.at.data());
  std::copy_n(here, image.cols, brightness.at.begin());
  // As in OpenCV's semi-global matcher, the outermost pixels have zero slope and a fixed brightness.
  for (PixelLine& line : lines) {
    line.at.front() = line.at.back() = kMaxSlope;
    line.find_extrema();
  }
}

void PixelCosts::row(const cv::Mat& left, const cv::Mat& right, int y, uint8_t* costs) {
  read(left, y, left_);
  read(right, y, right_);
  const auto from = [](const PixelLine& line, int column) {
    return Pointers{line.at.data(), line.low.data(), line.high.data()} + column;
  };
  // At the maximum disparity, the first column right of the margin corresponds to the second column of the right image.
  const auto pair = [&](size_t i) { return LinePair{from(left_[i], disparities_), from(right_[i], 1)}; };
  const auto compare = disparities_ % 32 == 0 ? compare_by_32 : compare_by_16;
  compare(pair(0), pair(1), left.cols - disparities_, disparities_, costs);
}

namespace {

// Penalties, per pixel of a block, for disparity changes of one and of more than one between adjacent pixels.
constexpr int kStepCost = 8, kLeapCost = 32;
constexpr int kMaxArea = SemiGlobalMatcher::kMaxBlockPx * SemiGlobalMatcher::kMaxBlockPx;
static_assert((PixelCosts::kMaxCost + 2 * kLeapCost) * kMaxArea <= INT16_MAX);
static_assert(PathCosts::kFar + kStepCost * kMaxArea <= INT16_MAX);
static_assert(PathCosts::kFar >= (PixelCosts::kMaxCost + kLeapCost) * kMaxArea);
constexpr int kIndexBits = 16;  // of a match: below its cost, the index of its disparity

HEDGEHOP_WIDE void add_times(const uint8_t* costs, int times, size_t count, int16_t* sums) {
  for (size_t i = 0; i < count; ++i) sums[i] = static_cast<int16_t>(sums[i] + times * costs[i]);
}

/// @param matches  cost of each pixel and index of its disparity. Of equal costs, the largest disparity has the
/// minimum.
HEDGEHOP_WIDE void find_whole_disparities(const WinnerRow& winners, int width, int disparities, int16_t* disparity16,
                                          int* matches) {
  const int16_t *const at = winners.at(), *const unique = winners.unique(), *const costs = winners.costs();
  for (int x = 0; x < width; ++x) {
    const auto whole = static_cast<int16_t>((disparities - 1 - at[x]) * kUnitsPerPixel);
    disparity16[x] = unique[x] != 0 ? whole : kUnmatched;
    matches[x] = unique[x] != 0 ? (costs[x] << kIndexBits) + at[x] : INT32_MAX;
  }
}

/// Computes the fractions of the disparities x 16, to be truncated; 1/2 at the ends and without a match.
HEDGEHOP_WIDE void find_parts(const WinnerRow& winners, int width, int disparities, int* dividends, int* divisors) {
  const int16_t *const at = winners.at(), *const unique = winners.unique(), *const costs = winners.costs(),
                       *const before = winners.costs_before(), *const after = winners.costs_after();
  for (int x = 0; x < width; ++x) {
    const int inside = unique[x] & (at[x] > 0) & (at[x] < disparities - 1);
    const int curvature = std::max(after[x] + before[x] - 2 * costs[x], 1);
    dividends[x] = (after[x] - before[x]) * inside * kUnitsPerPixel + curvature;
    divisors[x] = 2 * curvature;
  }
}

}  // namespace

SemiGlobalMatcher::SemiGlobalMatcher(const SemiGlobalConfig& config, cv::Size size)
    : config_(config),
      width_(size.width - config.disparities_px),
      height_(size.height),
      pixel_costs_(size.width, config.disparities_px),
      columns_(static_cast<size_t>(std::max(width_, 0)) * static_cast<size_t>(config.disparities_px)),
      paths_({.width = width_,
              .disparities = config.disparities_px,
              .half = config.block_px / 2,
              .step_cost = static_cast<int16_t>(kStepCost * config.block_px * config.block_px),
              .leap_cost = static_cast<int16_t>(kLeapCost * config.block_px * config.block_px),
              .uniqueness_percent = config.uniqueness_percent,
              .max_lanes = config.max_lanes}),
      right_matches_(static_cast<size_t>(size.width) + 1),  // one more for the disparity -1 of unmatched pixels
      matches_(static_cast<size_t>(width_)),
      dividends_(matches_),
      divisors_(matches_) {
  pixels_.resize(columns_.size() * static_cast<size_t>(config.block_px + 1));
}

void SemiGlobalMatcher::compute(const cv::Mat& left, const cv::Mat& right, cv::Mat& disparity16) {
  found_.create(left.size(), CV_16SC1);
  for (int y = 0; y < height_; ++y) {
    add_row(left, right, y);
    auto* const d = found_.ptr<int16_t>(y);
    choose_disparities(d);
    check_right_consistency(d);
  }
  cv::medianBlur(found_, disparity16, 3);
}

/// Adds row y and the rows of the blocks around it. The first and last rows are repeated.
void SemiGlobalMatcher::add_row(const cv::Mat& left, const cv::Mat& right, int y) {
  const int half = config_.block_px / 2;
  const auto pixels = [&](int row) {
    return pixels_.data() + static_cast<size_t>(row % (config_.block_px + 1)) * columns_.size();
  };
  if (y == 0) {
    std::fill(columns_.begin(), columns_.end(), int16_t{0});
    for (int row = 0; row <= std::min(half, height_ - 1); ++row) {
      pixel_costs_.row(left, right, row, pixels(row));
      const int above = row == 0 ? half : 0, below = row == height_ - 1 ? half - row : 0;
      add_times(pixels(row), 1 + above + below, columns_.size(), columns_.data());
    }
    paths_.begin(columns_);
    return paths_.add_row(pixels(0), pixels(0));
  }
  if (y + half < height_) pixel_costs_.row(left, right, y + half, pixels(y + half));
  paths_.add_row(pixels(std::min(y + half, height_ - 1)), pixels(std::max(y - half - 1, 0)));
}

/// Computes the best disparity of each pixel in a row, in 1/16 px: the minimum of a parabola through three costs. Also
/// matches the pixels of the right image.
void SemiGlobalMatcher::choose_disparities(int16_t* disparity16) {
  const int disparities = config_.disparities_px;
  const WinnerRow& winners = paths_.winners();
  std::fill_n(disparity16, disparities, kUnmatched);
  find_whole_disparities(winners, width_, disparities, disparity16 + disparities, matches_.data());
  find_parts(winners, width_, disparities, dividends_.data(), divisors_.data());
  for (int x = 0; x < width_; ++x) {
    // Truncated floats have the value of the integer division, because both operands have at most 21 bits.
    const auto i = static_cast<size_t>(x);
    const auto part = static_cast<int>(static_cast<float>(dividends_[i]) / static_cast<float>(divisors_[i]));
    disparity16[x + disparities] = static_cast<int16_t>(disparity16[x + disparities] + part);
  }
  std::fill(right_matches_.begin(), right_matches_.end(), INT32_MAX);
  int* const right = right_matches_.data() + 1;
  for (int x = 0; x < width_; ++x) {
    int& match = right[x + winners.at()[x]];
    match = std::min(match, matches_[static_cast<size_t>(x)]);
  }
  for (int& match : right_matches_) match = disparities - 1 - match % (1 << kIndexBits);
}

/// Removes disparities that contradict the match of the corresponding right pixel, at both adjacent integer
/// disparities.
void SemiGlobalMatcher::check_right_consistency(int16_t* disparity16) const {
  const int* const matches = right_matches_.data();
  const int tolerance = config_.left_right_px;
  const auto contradicts = [&](int x, int disparity) {
    const int other = matches[x - disparity];
    return (other >= 0) & (std::abs(other - disparity) > tolerance);
  };
  for (int x = config_.disparities_px; x < width_ + config_.disparities_px; ++x) {
    const int below = disparity16[x] >> kUnitBits, above = (disparity16[x] + kUnitsPerPixel - 1) >> kUnitBits;
    const bool wrong = contradicts(x, below) & contradicts(x, above);
    disparity16[x] = wrong ? kUnmatched : disparity16[x];
  }
}

}  // namespace hedgehop::vision::stereo
