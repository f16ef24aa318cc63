#include "vision/stereo/semi_global_matcher.h"

#include <algorithm>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

#include "vision/flow/wide_integers.h"
#include "vision/stereo/disparity.h"

namespace hedgehop::vision::stereo {

namespace {

constexpr int kMaxSlope = 31;        // slopes are limited to +-31 and stored as slope + 31
constexpr int kBrightnessShift = 2;  // weight of brightness relative to slope: 1/4

uint8_t excess(uint8_t a, uint8_t b) { return static_cast<uint8_t>(std::max(a, b) - b); }

HEDGEHOP_WIDE void slopes(const uint8_t* above, const uint8_t* here, const uint8_t* below, int width, uint8_t* to) {
  for (int x = 1; x < width - 1; ++x) {
    const auto slope = static_cast<int16_t>((here[x + 1] - here[x - 1]) * 2 + above[x + 1] - above[x - 1] +
                                            below[x + 1] - below[x - 1]);
    to[x] = static_cast<uint8_t>(std::clamp<int16_t>(slope, -kMaxSlope, kMaxSlope) + kMaxSlope);
  }
}

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
  slopes(image.ptr<uint8_t>(std::max(y - 1, 0)), here, image.ptr<uint8_t>(std::min(y + 1, image.rows - 1)), image.cols,
         slope.at.data());
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
constexpr int kUnitsPerPixel = static_cast<int>(kDisparityUnits);
constexpr int16_t kUnmatched = -kUnitsPerPixel;

HEDGEHOP_WIDE void add_times(const uint8_t* costs, int times, size_t count, int16_t* sums) {
  for (size_t i = 0; i < count; ++i) sums[i] = static_cast<int16_t>(sums[i] + times * costs[i]);
}

HEDGEHOP_WIDE void replace(const uint8_t* enters, const uint8_t* leaves, size_t count, int16_t* sums) {
  for (size_t i = 0; i < count; ++i) sums[i] = static_cast<int16_t>(sums[i] + enters[i] - leaves[i]);
}

/// Computes the block around the column before the first one, whose pixels are repeated; `half` columns are right of
/// it.
HEDGEHOP_WIDE void sum_first_square(const int16_t* columns, int width, int disparities, int half, int16_t* square) {
  for (int d = 0; d < disparities; ++d) square[d] = static_cast<int16_t>((half + 1) * columns[d]);
  for (int x = 0; x < half; ++x) {
    const int16_t* column = columns + std::min(x, width - 1) * static_cast<ptrdiff_t>(disparities);
    for (int d = 0; d < disparities; ++d) square[d] = static_cast<int16_t>(square[d] + column[d]);
  }
}

}  // namespace

SemiGlobalMatcher::SemiGlobalMatcher(const SemiGlobalConfig& config, cv::Size size)
    : config_(config),
      width_(size.width - config.disparities_px),
      height_(size.height),
      pixel_costs_(size.width, config.disparities_px),
      columns_(static_cast<size_t>(std::max(width_, 0)) * static_cast<size_t>(config.disparities_px)),
      first_square_(static_cast<size_t>(config.disparities_px)),
      squares_(columns_),
      sums_(columns_),
      from_left_(2, config.disparities_px),
      from_right_(from_left_),
      from_above_(width_ + 1, config.disparities_px),
      from_above_before_(from_above_),
      from_above_left_(from_above_),
      from_above_right_(from_above_),
      winners_(static_cast<size_t>(width_)),
      right_costs_(static_cast<size_t>(size.width)),
      right_disparities_(right_costs_) {
  pixels_.resize(columns_.size() * static_cast<size_t>(config.block_px + 1));
}

void SemiGlobalMatcher::compute(const cv::Mat& left, const cv::Mat& right, cv::Mat& disparity16) {
  found_.create(left.size(), CV_16SC1);
  for (PathCosts* path : {&from_above_, &from_above_before_, &from_above_left_, &from_above_right_}) path->clear();
  const int area = config_.block_px * config_.block_px;
  const PathRow row{.width = width_,
                    .disparities = config_.disparities_px,
                    .half = config_.block_px / 2,
                    .step_cost = static_cast<int16_t>(kStepCost * area),
                    .leap_cost = static_cast<int16_t>(kLeapCost * area),
                    .narrow = config_.narrow,
                    .columns = columns_.data(),
                    .square_before = first_square_.data(),
                    .squares = squares_.data(),
                    .sums = sums_.data()};
  for (int y = 0; y < height_; ++y) {
    add_row(left, right, y);
    sum_first_square(columns_.data(), width_, row.disparities, row.half, first_square_.data());
    for (PathCosts* path : {&from_left_, &from_right_}) path->clear();
    std::swap(from_above_, from_above_before_);
    walk_right(row, from_left_, from_above_before_, from_above_, from_above_right_);
    walk_left(row, from_right_, from_above_left_, config_.uniqueness_percent, winners_.data());
    auto* const d = found_.ptr<int16_t>(y);
    choose_disparities(d);
    check_right_consistency(d);
  }
  cv::medianBlur(found_, disparity16, 3);
}

/// Updates the sums of columns to a block's rows around row y. The first and last rows are repeated.
void SemiGlobalMatcher::add_row(const cv::Mat& left, const cv::Mat& right, int y) {
  const int half = config_.block_px / 2;
  const size_t count = columns_.size();
  const auto pixels = [&](int row) {
    return pixels_.data() + static_cast<size_t>(row % (config_.block_px + 1)) * count;
  };
  if (y == 0) {
    std::fill(columns_.begin(), columns_.end(), int16_t{0});
    for (int row = 0; row <= std::min(half, height_ - 1); ++row) {
      pixel_costs_.row(left, right, row, pixels(row));
      const int above = row == 0 ? half : 0, below = row == height_ - 1 ? half - row : 0;
      add_times(pixels(row), 1 + above + below, count, columns_.data());
    }
  } else {
    if (y + half < height_) pixel_costs_.row(left, right, y + half, pixels(y + half));
    replace(pixels(std::min(y + half, height_ - 1)), pixels(std::max(y - half - 1, 0)), count, columns_.data());
  }
}

/// Computes the best disparity of each pixel in a row, in 1/16 px: the minimum of a parabola through three costs.
void SemiGlobalMatcher::choose_disparities(int16_t* disparity16) {
  const int disparities = config_.disparities_px;
  std::fill_n(disparity16, width_ + disparities, kUnmatched);
  std::fill(right_costs_.begin(), right_costs_.end(), INT16_MAX);
  std::fill(right_disparities_.begin(), right_disparities_.end(), kUnmatched);
  for (int x = width_ - 1; x >= 0; --x) {
    const Winner& winner = winners_[static_cast<size_t>(x)];
    if (!winner.unique) continue;
    int disparity = disparities - 1 - winner.at;
    const auto seen_right = static_cast<size_t>(x + disparities - disparity);
    if (right_costs_[seen_right] > winner.cost) {
      right_costs_[seen_right] = winner.cost;
      right_disparities_[seen_right] = static_cast<int16_t>(disparity);
    }
    disparity *= kUnitsPerPixel;
    if (winner.at > 0 && winner.at < disparities - 1) {
      const int16_t* sum = sums_.data() + static_cast<ptrdiff_t>(x) * disparities + winner.at;
      const int less = sum[1], more = sum[-1], curvature = std::max(less + more - 2 * sum[0], 1);
      disparity += ((less - more) * kUnitsPerPixel + curvature) / (2 * curvature);
    }
    disparity16[x + disparities] = static_cast<int16_t>(disparity);
  }
}

/// Removes disparities that contradict the match of the corresponding right pixel, at both adjacent integer
/// disparities.
void SemiGlobalMatcher::check_right_consistency(int16_t* disparity16) const {
  const auto agrees = [&](int x, int disparity) {
    const int other = right_disparities_[static_cast<size_t>(x - disparity)];
    return other < 0 || std::abs(other - disparity) <= config_.left_right_px;
  };
  for (int x = config_.disparities_px; x < width_ + config_.disparities_px; ++x) {
    if (disparity16[x] < 0) continue;
    const int below = disparity16[x] / kUnitsPerPixel, above = (disparity16[x] + kUnitsPerPixel - 1) / kUnitsPerPixel;
    if (!agrees(x, below) && !agrees(x, above)) disparity16[x] = kUnmatched;
  }
}

}  // namespace hedgehop::vision::stereo
