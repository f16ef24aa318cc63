#include "vision/mapping/depth_blocks.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "vision/stereo/cost_lanes.h"

namespace hedgehop::vision::mapping {
namespace {

constexpr int kPx = DepthBlocks::kBlockPx;

using stereo::Lanes8, stereo::load, stereo::load_bytes;  // one row of a block
static_assert(kPx == 8);

int sum(const Lanes8& lanes, int begin, int end) {
  int total = 0;
  for (int i = begin; i < end; ++i) total += lanes[i];
  return total;
}

/// The largest numbers of each of eight lanes, largest first.
class LargestByLane {
 public:
  static constexpr int kCount = 5;

  void add(Lanes8 numbers) {
    for (Lanes8& large : largest_) {
      const Lanes8 smaller = stereo::minimum(large, numbers);
      large = large > numbers ? large : numbers;
      numbers = smaller;
    }
  }

  /// Returns the number with `rank` larger or equal ones before it among all lanes. @param rank  0..kCount - 1.
  int16_t at(int rank) const {
    std::array<std::array<int16_t, 8>, kCount> numbers;
    std::memcpy(numbers.data(), largest_.data(), sizeof numbers);
    std::array<size_t, 8> used{};
    int16_t largest = 0;
    for (int i = 0; i <= rank; ++i) {
      size_t best = 0;
      for (size_t lane = 1; lane < 8; ++lane) {
        if (numbers[used[lane]][lane] > numbers[used[best]][best]) best = lane;
      }
      largest = numbers[used[best]++][best];
    }
    return largest;
  }

 private:
  static constexpr int16_t kNone = std::numeric_limits<int16_t>::min();
  static constexpr Lanes8 kNones = {kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone};
  std::array<Lanes8, kCount> largest_ = {kNones, kNones, kNones, kNones, kNones};
};

/// Sets the kind and the nearest disparity of a block. The few largest disparities are ignored, because single pixels
/// can be wrong, while a pole one pixel wide covers a column of eight.
void read_disparity(const cv::Mat& disparity16, const cv::Mat& smeared, int row, int col, DepthBlock& block) {
  constexpr int kMinMatched = kPx * kPx / 2;  // half of a block
  constexpr int kMinNear = 6;                 // pixels of a pole one pixel wide
  LargestByLane largest;
  Lanes8 matched{}, uncertain{};  // minus the numbers of such pixels
  for (int v = row * kPx; v < (row + 1) * kPx; ++v) {
    const auto d = load<Lanes8>(disparity16.ptr<int16_t>(v) + col * kPx);
    const auto s = load_bytes<Lanes8>(smeared.ptr<uint8_t>(v) + col * kPx);
    largest.add(d);
    matched += d >= 0;
    uncertain += (d >= 0) & (s != 0);
  }
  const int count = -sum(matched, 0, kPx), certain = count + sum(uncertain, 0, kPx);
  block.kind = certain >= kMinMatched ? DepthBlock::Kind::matched
               : count >= kMinMatched ? DepthBlock::Kind::smeared
                                      : DepthBlock::Kind::unknown;
  static_assert(LargestByLane::kCount > kPx * kPx / 16);
  block.near16 = count < kMinNear ? int16_t{-1} : largest.at(std::max(2, count / 16));
}

/// Returns the mean over the matched pixels of a block, rounded up.
int16_t mean_sigma16(const cv::Mat& disparity16, const cv::Mat& sigma16, int row, int col) {
  int sum = 0, count = 0;
  for (int v = row * kPx; v < (row + 1) * kPx; ++v) {
    for (int u = col * kPx; u < (col + 1) * kPx; ++u) {
      if (disparity16.at<int16_t>(v, u) < 0) continue;
      sum += sigma16.at<int16_t>(v, u);
      ++count;
    }
  }
  return static_cast<int16_t>(count > 0 ? (sum + count - 1) / count : -1);
}

void read_grey(const cv::Mat& grey, int row, int col, DepthBlock& block) {
  constexpr int kHalf = kPx / 2;
  std::array<int, 4> quarter{};
  for (int half = 0; half < 2; ++half) {
    Lanes8 sums{};
    for (int v = 0; v < kHalf; ++v) {
      sums += load_bytes<Lanes8>(grey.ptr<uint8_t>(row * kPx + half * kHalf + v) + col * kPx);
    }
    quarter[static_cast<size_t>(2 * half)] = sum(sums, 0, kHalf);
    quarter[static_cast<size_t>(2 * half + 1)] = sum(sums, kHalf, kPx);
  }
  const auto [darkest, brightest] = std::ranges::minmax(quarter);
  const int total = quarter[0] + quarter[1] + quarter[2] + quarter[3];
  block.grey = static_cast<uint8_t>(total / (kPx * kPx));
  block.range = static_cast<uint8_t>((brightest - darkest) / (kHalf * kHalf));
}

/// Computes by how much each pixel is darker than both sides within a few pixels: the black top-hat transform. It is
/// zero at edges and small for camera noise.
void find_valleys(const cv::Mat& grey, cv::Mat& valleys) {
  constexpr int kWindowPx = 5;  // wider than a line
  cv::morphologyEx(grey, valleys, cv::MORPH_BLACKHAT, cv::Mat::ones(kWindowPx, kWindowPx, CV_8U));
}

/// Returns whether a block contains enough of a valley to be part of a line.
bool is_lined(const cv::Mat& valleys, int row, int col) {
  constexpr int16_t kDarker = 25;    // grey levels, above noise
  constexpr int kMinDarkPixels = 4;  // half of a line through the block
  Lanes8 dark{};
  for (int v = 0; v < kPx; ++v) {
    dark += load_bytes<Lanes8>(valleys.ptr<uint8_t>(row * kPx + v) + col * kPx) > kDarker;
  }
  return -sum(dark, 0, kPx) >= kMinDarkPixels;
}

}  // namespace

void DepthBlocks::build(const cv::Mat& disparity16, const cv::Mat& grey, int smear_px, const cv::Mat& sigma16) {
  stereo::find_smeared(disparity16, smear_px, smeared_);
  if (!grey.empty()) find_valleys(grey, valleys_);
  rows_ = disparity16.rows / kPx;
  cols_ = disparity16.cols / kPx;
  blocks_.assign(static_cast<size_t>(rows_ * cols_), {});
  for (int row = 0; row < rows_; ++row) {
    for (int col = 0; col < cols_; ++col) {
      read_disparity(disparity16, smeared_, row, col, at(row, col));
      if (!sigma16.empty()) at(row, col).sigma16 = mean_sigma16(disparity16, sigma16, row, col);
      if (grey.empty()) continue;
      read_grey(grey, row, col, at(row, col));
      at(row, col).lined = is_lined(valleys_, row, col);
    }
  }
}

void DepthBlocks::add_lines(const cv::Mat& lines16) {
  constexpr int kSame16 = 16;  // difference of disparity of a line that the block matcher has found, too
  for (int row = 0; row < std::min(rows_, lines16.rows); ++row) {
    for (int col = 0; col < std::min(cols_, lines16.cols); ++col) {
      DepthBlock& block = at(row, col);
      const int16_t line16 = lines16.at<int16_t>(row, col);
      if (line16 < 0 || line16 < block.near16 - kSame16) continue;
      block.near16 = std::max(block.near16, line16);
      block.sigma16 = -1;
      block.thin = true;
    }
  }
}

double DepthBlocks::share(DepthBlock::Kind kind) const {
  if (blocks_.empty()) return 0.0;
  return static_cast<double>(std::ranges::count(blocks_, kind, &DepthBlock::kind)) /
         static_cast<double>(blocks_.size());
}

}  // namespace hedgehop::vision::mapping
