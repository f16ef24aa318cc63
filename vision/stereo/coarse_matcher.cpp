#include "vision/stereo/coarse_matcher.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "vision/stereo/disparity.h"

namespace hedgehop::vision::stereo {
namespace {

constexpr int kReductions[] = {2, 4};
constexpr int kMinWindowPx = 11;

/// Returns the config of the matcher of reduced images.
StereoMatcherConfig reduced(const StereoMatcherConfig& fine, int reduction) {
  constexpr int kMultiple = 16;  // of the number of disparities
  // Sum of the slopes of noise of 2 grey levels in a window of 11 px at half the resolution: 330.
  constexpr int kTexture = 500;
  StereoMatcherConfig config = fine;
  config.method = StereoMatcherConfig::Method::block;
  config.block_px = std::max(fine.block_px, kMinWindowPx);
  config.disparities_px = (fine.disparities_px / reduction + kMultiple - 1) / kMultiple * kMultiple;
  config.texture = kTexture * 2 / reduction;
  return config;
}

}  // namespace

CoarseMatcher::CoarseMatcher(const StereoMatcherConfig& fine)
    : half_window_px_(std::max(fine.block_px, kMinWindowPx) / 2) {
  for (const int reduction : kReductions) {
    levels_.push_back({reduction, StereoMatcher(reduced(fine, reduction)), {}, {}, {}, {}});
  }
}

int CoarseMatcher::fill(const cv::Mat& left, const cv::Mat& right, double fine_sigma_px, cv::Mat& disparity16,
                        cv::Mat& sigma16) {
  constexpr int kSameSegment16 = 32, kSpeckPx = 100;
  constexpr int kContrastPx = 9;  // side of the square in which a pixel's surface must be faint
  constexpr int kFaint = 30;      // maximum range of grey levels; that of noise of 2 is about 10
  const auto sigma_of = [&](int reduction) {
    return static_cast<int16_t>(std::ceil(kDisparityUnits * fine_sigma_px * reduction));
  };
  sigma16.create(disparity16.size(), CV_16SC1);
  sigma16.setTo(sigma_of(1));
  // Coarse windows do not see a thin object, which has contrast.
  const cv::Mat nearby = cv::Mat::ones(kContrastPx, kContrastPx, CV_8U);
  cv::morphologyEx(left, contrast_, cv::MORPH_GRADIENT, nearby);
  int filled = 0;
  for (Level& level : levels_) {
    const cv::Size size(left.cols / level.reduction, left.rows / level.reduction);
    const cv::Rect whole({}, size * level.reduction);
    cv::resize(left(whole), level.left, size, 0.0, 0.0, cv::INTER_AREA);
    cv::resize(right(whole), level.right, size, 0.0, 0.0, cv::INTER_AREA);
    level.matcher.match(level.left, level.right, level.disparity16);
    remove_specks(level.disparity16, kSameSegment16, kSpeckPx);
    find_smeared(level.disparity16, half_window_px_, level.smeared);
    const int16_t sigma = sigma_of(level.reduction);
    for (int v = 0; v < whole.height; ++v) {
      const auto* const from = level.disparity16.ptr<int16_t>(v / level.reduction);
      const auto* const smeared = level.smeared.ptr<uint8_t>(v / level.reduction);
      const auto* const contrast = contrast_.ptr<uint8_t>(v);
      auto* const to = disparity16.ptr<int16_t>(v);
      auto* const its_sigma = sigma16.ptr<int16_t>(v);
      for (int u = 0; u < whole.width; ++u) {
        const int at = u / level.reduction;
        if (to[u] >= 0 || from[at] < 0 || smeared[at] != 0 || contrast[u] > kFaint) continue;
        to[u] = static_cast<int16_t>(level.reduction * from[at]);
        its_sigma[u] = sigma;
        ++filled;
      }
    }
  }
  return filled;
}

}  // namespace hedgehop::vision::stereo
