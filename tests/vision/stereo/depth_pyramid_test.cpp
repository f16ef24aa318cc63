#include "vision/stereo/flight_corridor.h"

#include <gtest/gtest.h>

#include "tests/vision/stereo/random_disparity.h"

namespace hedgehop::vision::stereo {
namespace {

TEST(DepthPyramid, EveryPixelIsTheNearestOfItsBlock) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 30; ++trial) {
    const cv::Size size(50 + trial, 41);
    const cv::Mat d = random_disparity(random, size, trial);
    DepthPyramid pyramid;
    pyramid.build(d, 4);
    for (int n = 0; n <= pyramid.top(); ++n) {
      ASSERT_EQ(pyramid.level(n).cols * (1 << n), (size.width + 15) / 16 * 16);
      for (int row = 0; row < pyramid.level(n).rows; ++row) {
        for (int col = 0; col < pyramid.level(n).cols; ++col) {
          const cv::Rect square = cv::Rect(col << n, row << n, 1 << n, 1 << n) & cv::Rect({}, size);
          double nearest = kNoDisparity;
          if (!square.empty()) cv::minMaxLoc(d(square), nullptr, &nearest);
          ASSERT_EQ(pyramid.disparity16(n, row, col), nearest) << n << ' ' << row << ' ' << col;
        }
      }
    }
  }
}

TEST(DepthPyramid, RejectsOtherImageTypes) {
  DepthPyramid pyramid;
  EXPECT_THROW(pyramid.build(cv::Mat(8, 8, CV_8UC1), 2), std::invalid_argument);
  EXPECT_THROW(pyramid.build(cv::Mat(8, 8, CV_16SC1), -1), std::invalid_argument);
}

}  // namespace
}  // namespace hedgehop::vision::stereo
