#include "vision/stereo/disparity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <queue>

#include "tests/vision/stereo/random_disparity.h"

namespace hedgehop::vision::stereo {
namespace {

/// Segments by flood fill, pixel by pixel, as an independent method.
cv::Mat without_specks(const cv::Mat& d, int difference16, int smallest_px) {
  cv::Mat result = d.clone(), seen(d.size(), CV_8U, cv::Scalar(0));
  for (int v = 0; v < d.rows; ++v) {
    for (int u = 0; u < d.cols; ++u) {
      if (d.at<int16_t>(v, u) < 0 || seen.at<uint8_t>(v, u)) continue;
      std::vector<cv::Point> segment;
      std::queue<cv::Point> open({cv::Point(u, v)});
      seen.at<uint8_t>(v, u) = 1;
      while (!open.empty()) {
        const cv::Point p = open.front();
        open.pop();
        segment.push_back(p);
        for (int dv = -1; dv <= 1; ++dv) {
          for (int du = -1; du <= 1; ++du) {
            const cv::Point q(p.x + du, p.y + dv);
            if (!cv::Rect({}, d.size()).contains(q) || seen.at<uint8_t>(q) || d.at<int16_t>(q) < 0) continue;
            if (std::abs(d.at<int16_t>(p) - d.at<int16_t>(q)) >= difference16) continue;
            seen.at<uint8_t>(q) = 1;
            open.push(q);
          }
        }
      }
      if (static_cast<int>(segment.size()) >= smallest_px) continue;
      for (const cv::Point& p : segment) result.at<int16_t>(p) = kNoDisparity;
    }
  }
  return result;
}

TEST(Disparity, DepthIsBaselineTimesFocalLengthOverDisparity) {
  const StereoGeometry geometry{512.0, 319.5, 239.5, 0.3};
  EXPECT_NEAR(geometry.z_m(16 * 8), 0.3 * 512.0 / 8.0, 1e-12);
  EXPECT_EQ(geometry.z_m(0), std::numeric_limits<double>::infinity());
  EXPECT_NEAR(geometry.disparity16(geometry.z_m(123)), 123.0, 1e-9);
}

TEST(Disparity, SpecksEqualThoseOfAFloodFill) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const cv::Mat before = random_disparity(random, {37 + trial % 20, 29}, trial);
    const int difference16 = 1 + trial % 40, smallest_px = 2 + trial % 30;
    cv::Mat after = before.clone();
    const int removed = remove_specks(after, difference16, smallest_px);
    EXPECT_EQ(cv::norm(after, without_specks(before, difference16, smallest_px), cv::NORM_INF), 0.0) << trial;
    EXPECT_EQ(removed, cv::countNonZero(after != before)) << trial;
  }
}

TEST(Disparity, DifferenceEqualToTheThresholdSeparatesSegments) {
  cv::Mat d(1, 4, CV_16SC1);
  d.at<int16_t>(0, 0) = 100;
  d.at<int16_t>(0, 1) = 103;
  d.at<int16_t>(0, 2) = 107;
  d.at<int16_t>(0, 3) = 110;
  remove_specks(d, 4, 3);  // 103 and 107 differ by 4: two segments of two
  EXPECT_EQ(cv::countNonZero(d < 0), 4);
}

TEST(Disparity, SkyIsUnknownBrightAndSmooth) {
  const uint8_t grey[] = {250, 250, 251, 200, 252, 253};
  const int16_t before[] = {-1, -1, 40, -1, -1, -1};
  //                        column 0, sky, known, edge and dark, edge, sky
  const int16_t after[] = {-1, 0, 40, -1, -1, 0};
  const cv::Mat image(1, 6, CV_8UC1, const_cast<uint8_t*>(grey));
  cv::Mat d = cv::Mat(1, 6, CV_16SC1, const_cast<int16_t*>(before)).clone();
  EXPECT_EQ(mark_sky(image, 5, 220, SkyAmong::unknown, d), 2);
  EXPECT_EQ(cv::norm(d, cv::Mat(1, 6, CV_16SC1, const_cast<int16_t*>(after)), cv::NORM_INF), 0.0);
}

TEST(Disparity, SkyAmongAllIncludesMatchedPixels) {
  const uint8_t grey[] = {250, 250, 251, 200, 252, 253};
  const int16_t before[] = {40, -1, 40, 40, 40, 40};
  const int16_t after[] = {40, 0, 0, 40, 40, 0};
  const cv::Mat image(1, 6, CV_8UC1, const_cast<uint8_t*>(grey));
  cv::Mat d = cv::Mat(1, 6, CV_16SC1, const_cast<int16_t*>(before)).clone();
  EXPECT_EQ(mark_sky(image, 5, 220, SkyAmong::all, d), 3);
  EXPECT_EQ(cv::norm(d, cv::Mat(1, 6, CV_16SC1, const_cast<int16_t*>(after)), cv::NORM_INF), 0.0);
}

TEST(Disparity, SkyIsFoundPixelByPixel) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 40; ++trial) {
    const cv::Size size(1 + trial * 3, 7);
    const cv::Mat before = random_disparity(random, size, trial);
    cv::Mat grey(size, CV_8UC1), after = before.clone(), expected = before.clone();
    cv::RNG(static_cast<uint64_t>(trial) + 1).fill(grey, cv::RNG::UNIFORM, 200, 256);
    const SkyAmong among = trial % 2 == 0 ? SkyAmong::all : SkyAmong::unknown;
    int count = 0;
    for (int v = 0; v < size.height; ++v) {
      for (int u = 1; u < size.width; ++u) {
        const int step = std::abs(grey.at<uint8_t>(v, u) - grey.at<uint8_t>(v, u - 1));
        const bool tested = among == SkyAmong::all || before.at<int16_t>(v, u) < 0;
        if (!tested || step >= 20 || grey.at<uint8_t>(v, u) <= 220) continue;
        expected.at<int16_t>(v, u) = 0;
        ++count;
      }
    }
    EXPECT_EQ(mark_sky(grey, 20, 220, among, after), count) << trial;
    EXPECT_EQ(cv::norm(after, expected, cv::NORM_INF), 0.0) << trial;
  }
}

TEST(Disparity, ToDepthKeepsUnknownAndInfinity) {
  const int16_t values[] = {-1, 0, 16};
  cv::Mat depth_m;
  to_depth(cv::Mat(1, 3, CV_16SC1, const_cast<int16_t*>(values)), {100.0, 0.0, 0.0, 0.5}, depth_m);
  EXPECT_TRUE(std::isnan(depth_m.at<float>(0, 0)));
  EXPECT_EQ(depth_m.at<float>(0, 1), std::numeric_limits<float>::infinity());
  EXPECT_FLOAT_EQ(depth_m.at<float>(0, 2), 50.0f);
}

}  // namespace
}  // namespace hedgehop::vision::stereo
