#include "vision/flow/corner_tracker.h"

#include <gtest/gtest.h>

#include <array>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <string>
#include <vector>

#include "vision/flow/corner_window.h"

namespace hedgehop::vision::flow {
namespace {

cv::Mat smooth_image(uint64_t seed, cv::Size size, double sigma_px) {
  cv::Mat image(size, CV_8UC1);
  cv::RNG(seed).fill(image, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(image, image, {}, sigma_px);
  return 4 * (image - 96);
}

struct Images {
  std::vector<cv::Mat> from, to;
  std::vector<cv::Point2f> corners;

  Images(cv::Size size, double sigma_px, int window_px, int levels) {
    const cv::Mat older = smooth_image(3, size, sigma_px);
    cv::Mat newer;
    const cv::Mat motion = (cv::Mat_<double>(2, 3) << 1.01, 0.02, -5.3, -0.02, 1.01, 2.1);
    cv::warpAffine(older, newer, motion, size, cv::INTER_CUBIC, cv::BORDER_REFLECT);
    cv::buildOpticalFlowPyramid(older, from, {window_px, window_px}, levels - 1);
    cv::buildOpticalFlowPyramid(newer, to, {window_px, window_px}, levels - 1);
    cv::goodFeaturesToTrack(older, corners, 400, 0.01, 4.0);
    // Some corners without texture, at the border, or outside the image.
    for (const float x : {0.0F, 0.4F, 20.0F, static_cast<float>(size.width) - 1.0F, static_cast<float>(size.width)}) {
      corners.emplace_back(x, 7.3F);
      corners.emplace_back(x, static_cast<float>(size.height) - 0.6F);
    }
  }
};

// Floating-point sums differ. If a search stops one iteration earlier, the difference is its last step, 0.005 px.
TEST(CornerTracker, TracksCornersLikeOpenCv) {
  constexpr double kLastStepPx = 0.006, kFewPx = 1e-3;
  const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 30, 0.005);
  for (const int window_px : {5, 9, 15, 17, 33}) {
    for (const double sigma_px : {1.5, 3.0}) {
      constexpr int kLevels = 3;
      const Images images({321, 240}, sigma_px, window_px, kLevels);
      const cv::Size window(window_px, window_px);
      std::vector<cv::Point2f> ahead, back = images.corners;
      std::vector<uint8_t> seen, seen_again;
      cv::calcOpticalFlowPyrLK(images.from, images.to, images.corners, ahead, seen, cv::noArray(), window, kLevels - 1,
                               until);
      cv::calcOpticalFlowPyrLK(images.to, images.from, ahead, back, seen_again, cv::noArray(), window, kLevels - 1,
                               until, cv::OPTFLOW_USE_INITIAL_FLOW);
      CornerTracker tracker(window_px, kLevels);
      size_t far = 0, otherwise_seen = 0, followed = 0;
      for (size_t i = 0; i < images.corners.size(); ++i) {
        const auto found = tracker.track(images.from, images.to, images.corners[i]);
        otherwise_seen += found.has_value() != (seen[i] != 0);
        if (!found || !seen[i]) continue;
        ++followed;
        const double off_px = cv::norm(*found - ahead[i]);
        EXPECT_LT(off_px, kLastStepPx) << window_px << " " << images.corners[i];
        far += off_px > kFewPx;
        const auto returned = tracker.track(images.to, images.from, *found, images.corners[i]);
        otherwise_seen += returned.has_value() != (seen_again[i] != 0);
        if (returned && seen_again[i]) {
          EXPECT_LT(cv::norm(*returned - back[i]), 2.0 * kLastStepPx);
        }
      }
      EXPECT_GT(followed, images.corners.size() * 9 / 10);
      EXPECT_LE(far, images.corners.size() / 50);
      EXPECT_EQ(otherwise_seen, 0U);
    }
  }
}

/// Interpolates numbers at (x, y) with rounding to `bits` fewer bits.
int interpolated(const cv::Mat& image, int channel, int x, int y, const CornerWeights& weights, int bits) {
  const auto at = [&](int u, int v) {
    return image.channels() == 1 ? int{image.at<uint8_t>(v, u)} : int{image.at<cv::Vec2s>(v, u)[channel]};
  };
  const int sum = at(x, y) * weights.top_left + at(x + 1, y) * weights.top_right + at(x, y + 1) * weights.bottom_left +
                  at(x + 1, y + 1) * weights.bottom_right;
  return (sum + (1 << (bits - 1))) >> bits;
}

// The oracle adds pixel by pixel.
TEST(CornerWindow, RowsHaveTheSumsOfSinglePixels) {
  cv::Mat older(80, 100, CV_8UC1), newer(80, 100, CV_8UC1), gradients(80, 100, CV_16SC2);
  cv::RNG random(9);
  for (cv::Mat* image : {&older, &newer}) random.fill(*image, cv::RNG::UNIFORM, 0, 256);
  random.fill(gradients, cv::RNG::UNIFORM, -4080, 4081);
  for (const int window : {3, 9, 11, 15, 17, 33}) {
    const int stride = (window + 7) / 8 * 8;
    std::vector<int16_t> grey(static_cast<size_t>(window * stride)), gradient_x(grey), gradient_y(grey);
    for (const cv::Point2f part : {cv::Point2f(0.0F, 0.0F), {0.3F, 0.9F}, {0.999F, 0.5F}}) {
      const CornerWeights weights(part);
      CornerRows rows{older.ptr<uint8_t>(2) + 3,
                      100,
                      gradients.ptr<int16_t>(2) + 6,
                      200,
                      grey.data(),
                      gradient_x.data(),
                      gradient_y.data(),
                      window,
                      stride};
      const auto products = load_rows(rows, weights);
      rows.pixels = newer.ptr<uint8_t>(5) + 7;
      const auto mismatch = mismatch_of_rows(rows, weights);
      std::array<int64_t, 3> expected_products{};
      std::array<int64_t, 2> expected_mismatch{};
      for (int y = 0; y < window; ++y) {
        for (int x = 0; x < window; ++x) {
          const int64_t slope_x = interpolated(gradients, 0, x + 3, y + 2, weights, 14);
          const int64_t slope_y = interpolated(gradients, 1, x + 3, y + 2, weights, 14);
          const int difference =
              interpolated(newer, 0, x + 7, y + 5, weights, 9) - interpolated(older, 0, x + 3, y + 2, weights, 9);
          expected_products[0] += slope_x * slope_x;
          expected_products[1] += slope_x * slope_y;
          expected_products[2] += slope_y * slope_y;
          expected_mismatch[0] += difference * slope_x;
          expected_mismatch[1] += difference * slope_y;
        }
      }
      EXPECT_EQ(products, expected_products) << window << " " << part;
      EXPECT_EQ(mismatch, expected_mismatch) << window << " " << part;
    }
  }
}

}  // namespace
}  // namespace hedgehop::vision::flow
