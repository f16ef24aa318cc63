#include "vision/stereo/coarse_matcher.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/vision/stereo/surface_images.h"
#include "vision/stereo/disparity.h"

namespace hedgehop::vision::stereo {
namespace {

constexpr int kWidth = 640, kHeight = 240;
constexpr double kSurfacePx = 9.3;  // disparity
constexpr StereoMatcherConfig kFine{.method = StereoMatcherConfig::Method::block, .disparities_px = 64, .block_px = 11};

/// The image of a faint surface, farther left by its disparity, with noise.
cv::Mat faint(double texture, double left_px, uint64_t noise_seed) {
  constexpr int kMargin = 64;
  const cv::Mat surface = textured_surface(7, {kWidth + kMargin, kHeight}, 4.0, texture);
  const cv::Mat noise = camera_noise(noise_seed, {kWidth, kHeight});
  cv::Mat image(kHeight, kWidth, CV_8UC1);
  const auto first = static_cast<int>(std::floor(left_px));
  const double share = left_px - first;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const double grey = (1.0 - share) * surface.at<float>(v, u + first) + share * surface.at<float>(v, u + first + 1);
      image.at<uint8_t>(v, u) = cv::saturate_cast<uint8_t>(grey + noise.at<float>(v, u));
    }
  }
  return image;
}

struct Filled {
  cv::Mat fine16, disparity16, sigma16;
  int filled = 0;
};

Filled fill(double texture) {
  const cv::Mat left = faint(texture, 0.0, 1), right = faint(texture, kSurfacePx, 2);
  Filled filled;
  StereoMatcher(kFine).match(left, right, filled.fine16);
  filled.disparity16 = filled.fine16.clone();
  filled.filled = CoarseMatcher(kFine).fill(left, right, 0.5, filled.disparity16, filled.sigma16);
  return filled;
}

TEST(CoarseMatcher, MatchesAFaintSurfaceThatTheBlockMatcherLeavesOpen) {
  const Filled filled = fill(/*texture=*/4.0);
  const int all = kWidth * kHeight, fine = cv::countNonZero(filled.fine16 >= 0);
  const int both = cv::countNonZero(filled.disparity16 >= 0);
  EXPECT_LT(fine, all / 2);
  EXPECT_EQ(both, fine + filled.filled);
  EXPECT_GT(both, 0.75 * all);
  int beyond = 0;  // three sigma
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const int d16 = filled.disparity16.at<int16_t>(v, u);
      if (d16 < 0 || filled.fine16.at<int16_t>(v, u) >= 0) continue;
      beyond += std::abs(d16 - kDisparityUnits * kSurfacePx) > 3.0 * filled.sigma16.at<int16_t>(v, u);
    }
  }
  EXPECT_LT(beyond, 0.01 * filled.filled);
}

TEST(CoarseMatcher, KeepsTheMatchesOfTheBlockMatcher) {
  const Filled filled = fill(/*texture=*/4.0);
  const cv::Mat matched = filled.fine16 >= 0;
  EXPECT_EQ(cv::countNonZero((filled.fine16 != filled.disparity16) & matched), 0);
}

TEST(CoarseMatcher, DoesNotMatchNoise) {
  const Filled filled = fill(/*texture=*/0.0);
  EXPECT_LT(filled.filled, 0.001 * kWidth * kHeight);
}

}  // namespace
}  // namespace hedgehop::vision::stereo
