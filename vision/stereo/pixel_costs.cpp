#include "vision/stereo/pixel_costs.h"

#include <algorithm>

#include "vision/flow/wide_integers.h"

namespace hedgehop::vision::stereo {
namespace {

constexpr int kMaxSlope = 31;        // slopes beyond are taken to be this; their lines hold slope + 31
constexpr int kBrightnessShift = 2;  // by which differences in brightness count less than those in slope

uint8_t over(uint8_t a, uint8_t b) { return static_cast<uint8_t>(std::max(a, b) - b); }

HEDGEHOP_WIDE void slopes(const uint8_t* above, const uint8_t* here, const uint8_t* below, int width, uint8_t* to) {
  for (int x = 1; x < width - 1; ++x) {
    const auto slope = static_cast<int16_t>((here[x + 1] - here[x - 1]) * 2 + above[x + 1] - above[x - 1] +
                                            below[x + 1] - below[x - 1]);
    to[x] = static_cast<uint8_t>(std::clamp<int16_t>(slope, -kMaxSlope, kMaxSlope) + kMaxSlope);
  }
}

HEDGEHOP_WIDE void spread_line(const uint8_t* at, int width, uint8_t* least, uint8_t* most) {
  for (int x = 1; x < width - 1; ++x) {
    const auto before = static_cast<uint8_t>((at[x] + at[x - 1]) / 2);
    const auto after = static_cast<uint8_t>((at[x] + at[x + 1]) / 2);
    least[x] = std::min(at[x], std::min(before, after));
    most[x] = std::max(at[x], std::max(before, after));
  }
}

/// Of one pixel, at sixteen disparities at a time.
struct Pixel {
  uint8_t at, least, most;
  /// @return how far the nearest of two half pixels' ranges is from the other's pixel.
  uint8_t differs(uint8_t other, uint8_t other_least, uint8_t other_most) const {
    const auto mine = static_cast<uint8_t>(over(at, other_most) + over(other_least, at));
    const auto theirs = static_cast<uint8_t>(over(other, most) + over(least, other));
    return std::min(mine, theirs);
  }
};

struct Pointers {
  const uint8_t *at, *least, *most;
  Pointers operator+(int columns) const { return {at + columns, least + columns, most + columns}; }
};

struct LinePair {
  Pointers left, right;
};

template <int kTogether>
[[gnu::always_inline]] inline void compare(const LinePair& slopes, const LinePair& brightnesses, int count,
                                           int disparities, uint8_t* __restrict costs) {
  for (int x = 0; x < count; ++x) {
    const Pixel slope{slopes.left.at[x], slopes.left.least[x], slopes.left.most[x]};
    const Pixel brightness{brightnesses.left.at[x], brightnesses.left.least[x], brightnesses.left.most[x]};
    for (int begin = 0; begin < disparities; begin += kTogether) {
      const Pointers s = slopes.right + (x + begin), b = brightnesses.right + (x + begin);
      uint8_t* cost = costs + static_cast<ptrdiff_t>(x) * disparities + begin;
      for (int i = 0; i < kTogether; ++i) {
        cost[i] = static_cast<uint8_t>(slope.differs(s.at[i], s.least[i], s.most[i]) +
                                       (brightness.differs(b.at[i], b.least[i], b.most[i]) >> kBrightnessShift));
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

void PixelCosts::PixelLine::spread() {
  const auto width = static_cast<int>(at.size());
  spread_line(at.data(), width, least.data(), most.data());
  // Beyond the ends there is nothing to be between.
  const auto end = [&](size_t x, size_t inner) {
    const auto between = static_cast<uint8_t>((at[x] + at[inner]) / 2);
    least[x] = std::min(at[x], between);
    most[x] = std::max(at[x], between);
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
  // As OpenCV's semi-global matcher has it: the outermost pixels have no slope, and a brightness that is as dark.
  for (PixelLine& line : lines) {
    line.at.front() = line.at.back() = kMaxSlope;
    line.spread();
  }
}

void PixelCosts::row(const cv::Mat& left, const cv::Mat& right, int y, uint8_t* costs) {
  read(left, y, left_);
  read(right, y, right_);
  const auto from = [](const PixelLine& line, int column) {
    return Pointers{line.at.data(), line.least.data(), line.most.data()} + column;
  };
  // At the largest disparity, the first column right of the margin lies in the second column of the right image.
  const auto pair = [&](size_t i) { return LinePair{from(left_[i], disparities_), from(right_[i], 1)}; };
  const auto compare = disparities_ % 32 == 0 ? compare_by_32 : compare_by_16;
  compare(pair(0), pair(1), left.cols - disparities_, disparities_, costs);
}

}  // namespace hedgehop::vision::stereo
