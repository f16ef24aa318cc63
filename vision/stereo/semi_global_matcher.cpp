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

// Penalties for a disparity that changes from one pixel to the next, per pixel of a square: by one, and by more.
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

/// The square about the column before the first, whose pixels are repeated: `half` columns lie right of it.
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
    choose(d);
    check_from_the_right(d);
  }
  cv::medianBlur(found_, disparity16, 3);
}

/// Moves the sums of columns on to a square's rows about row y; the first and the last row are repeated.
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

/// The best disparity of each pixel of a row, in 1/16 px: the least of a parabola through three costs.
void SemiGlobalMatcher::choose(int16_t* disparity16) {
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

/// Drops what the right image's pixel matches otherwise, by either of the whole disparities about the one found.
void SemiGlobalMatcher::check_from_the_right(int16_t* disparity16) const {
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
