#include "vision/mapping/depth_blocks.h"

#include <algorithm>
#include <array>
#include <functional>
#include <opencv2/imgproc.hpp>

namespace hedgehop::vision::mapping {
namespace {

constexpr int kPx = DepthBlocks::kBlockPx;

/// Sets the kind and the nearest disparity of a block. The few largest disparities are ignored, because single pixels
/// can be wrong, while a pole one pixel wide covers a column of eight.
void read_disparity(const cv::Mat& disparity16, const cv::Mat& smeared, int row, int col, DepthBlock& block) {
  constexpr int kMinMatched = kPx * kPx / 2;  // half of a block
  constexpr int kMinNear = 6;                 // pixels of a pole one pixel wide
  std::array<int16_t, kPx * kPx> matched;
  int count = 0, certain = 0;
  for (int v = row * kPx; v < (row + 1) * kPx; ++v) {
    const auto* const d = disparity16.ptr<int16_t>(v) + col * kPx;
    const auto* const s = smeared.ptr<uint8_t>(v) + col * kPx;
    for (int u = 0; u < kPx; ++u) {
      matched[static_cast<size_t>(count)] = d[u];
      count += d[u] >= 0;
      certain += d[u] >= 0 && s[u] == 0;
    }
  }
  block.kind = certain >= kMinMatched ? DepthBlock::Kind::matched
               : count >= kMinMatched ? DepthBlock::Kind::smeared
                                      : DepthBlock::Kind::unknown;
  block.near16 = -1;
  if (count < kMinNear) return;
  const auto rank = matched.begin() + std::max(2, count / 16);
  std::nth_element(matched.begin(), rank, matched.begin() + count, std::greater<>());
  block.near16 = *rank;
}

void read_grey(const cv::Mat& grey, int row, int col, DepthBlock& block) {
  constexpr int kHalf = kPx / 2;
  std::array<int, 4> quarter{};
  for (int v = 0; v < kPx; ++v) {
    const auto* const g = grey.ptr<uint8_t>(row * kPx + v) + col * kPx;
    for (int u = 0; u < kPx; ++u) quarter[static_cast<size_t>(2 * (v / kHalf) + u / kHalf)] += g[u];
  }
  const auto [darkest, brightest] = std::ranges::minmax(quarter);
  const int sum = quarter[0] + quarter[1] + quarter[2] + quarter[3];
  block.grey = static_cast<uint8_t>(sum / (kPx * kPx));
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
  constexpr int kDarker = 25,
                kMinDarkPixels = 4;  // grey levels, above noise; pixels, half of a line through the block
  int dark = 0;
  for (int v = 0; v < kPx; ++v) {
    const auto* const g = valleys.ptr<uint8_t>(row * kPx + v) + col * kPx;
    for (int u = 0; u < kPx; ++u) dark += g[u] > kDarker;
  }
  return dark >= kMinDarkPixels;
}

}  // namespace

void DepthBlocks::build(const cv::Mat& disparity16, const cv::Mat& grey, int smear_px) {
  smeared_ = disparity16 < 0;
  if (smear_px > 0) {
    // Areas that contain a complete window of unmatched pixels, enlarged by half a window.
    const auto square = [](int px) { return cv::Mat::ones(px, px, CV_8U); };
    cv::erode(smeared_, smeared_, square(2 * smear_px + 1));
    cv::dilate(smeared_, smeared_, square(4 * smear_px + 1));
  }
  if (!grey.empty()) find_valleys(grey, valleys_);
  rows_ = disparity16.rows / kPx;
  cols_ = disparity16.cols / kPx;
  blocks_.assign(static_cast<size_t>(rows_ * cols_), {});
  for (int row = 0; row < rows_; ++row) {
    for (int col = 0; col < cols_; ++col) {
      read_disparity(disparity16, smeared_, row, col, at(row, col));
      if (grey.empty()) continue;
      read_grey(grey, row, col, at(row, col));
      at(row, col).lined = is_lined(valleys_, row, col);
    }
  }
}

double DepthBlocks::share(DepthBlock::Kind kind) const {
  if (blocks_.empty()) return 0.0;
  return static_cast<double>(std::ranges::count(blocks_, kind, &DepthBlock::kind)) /
         static_cast<double>(blocks_.size());
}

}  // namespace hedgehop::vision::mapping
