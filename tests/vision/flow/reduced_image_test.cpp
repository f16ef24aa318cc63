#include "vision/flow/reduced_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "tests/vision/flow/textured_image.h"

namespace hedgehop::vision::flow {
namespace {

TEST(ImageReducer, HalvedPixelsLieAtTwiceTheirIndexPlusAHalf) {
  const int width = 60, height = 40;
  const cv::Mat ramp = draw_image(width, height, [](double u, double v) { return 2.0 * u + v; });
  ReducedImage half(width / 2, height / 2, 0);
  ImageReducer reducer(width, 12);
  reducer.halve(ramp, half);
  for (int y = 1; y < half.height() - 1; ++y) {
    for (int x = 1; x < half.width() - 1; ++x) {
      ASSERT_EQ(half.row(y)[x], 16 * (2.0 * (2 * x + 0.5) + (2 * y + 0.5)));
    }
  }
}

TEST(ImageReducer, HalvingTwiceEqualsOneLongFilter) {
  const int width = 64, height = 48;
  const WaveTexture texture(3, 5.0, 40.0);
  const cv::Mat image = draw_image(width, height, [&](double u, double v) { return texture.grey(u, v); });
  ReducedImage half(32, 24, 0), quarter(16, 12, 0);
  ImageReducer reducer(width, 12);
  reducer.halve(image, half);
  reducer.halve(half, quarter);
  // Both steps explicitly: 1 3 3 1, then again on every second result.
  const double w[4] = {1, 3, 3, 1};
  double long_filter[10] = {};
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) long_filter[2 * i + j] += w[i] * w[j] / 64.0;
  }
  for (int y = 2; y < 10; ++y) {
    for (int x = 2; x < 14; ++x) {
      double expected = 0.0;
      for (int i = 0; i < 10; ++i) {
        for (int j = 0; j < 10; ++j) {
          expected += long_filter[i] * long_filter[j] * image.at<uint8_t>(4 * y - 3 + i, 4 * x - 3 + j);
        }
      }
      constexpr double kRounding = 1.01;  // each step rounds to 1/16 grey level
      ASSERT_NEAR(quarter.row(y)[x], 16.0 * expected, kRounding);
    }
  }
}

TEST(ImageReducer, SmoothingIsBinomialAndRepeatsEdges) {
  std::mt19937_64 random(5);
  const int width = 21, height = 13;
  const cv::Mat image = draw_image(width, height, [&](double, double) { return static_cast<double>(random() % 256); });
  ReducedImage smooth(width, height, 3);
  ImageReducer reducer(width, 12);
  reducer.smooth(image, smooth);
  const auto pixel = [&](int x, int y) {
    return static_cast<double>(image.at<uint8_t>(std::clamp(y, 0, height - 1), std::clamp(x, 0, width - 1)));
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double sum = 0.0;
      for (int i = -1; i <= 1; ++i) {
        for (int j = -1; j <= 1; ++j) sum += (2 - std::abs(i)) * (2 - std::abs(j)) * pixel(x + j, y + i);
      }
      ASSERT_EQ(smooth.row(y)[x], sum);  // times 16 / 16
    }
  }
}

TEST(ImageReducer, BrightestImageNeitherOverflowsNorLosesLight) {
  for (const int bits : {10, 11, 12}) {
    const cv::Mat white(50, 50, CV_8UC1, cv::Scalar(255));
    ReducedImage half(25, 25, 0), quarter(12, 12, 0), smooth(25, 25, 0), full(50, 50, 0);
    ImageReducer reducer(50, bits);
    reducer.halve(white, half);
    reducer.halve(half, quarter);
    reducer.smooth(half, smooth);
    reducer.smooth(white, full);
    const int expected = 255 << (bits - 8);
    for (const ReducedImage* image : {&half, &quarter, &smooth, &full}) {
      for (int y = 0; y < image->height(); ++y) {
        for (int x = 0; x < image->width(); ++x) ASSERT_EQ(image->row(y)[x], expected) << bits;
      }
    }
  }
}

TEST(ImageReducer, RefusesBitsThatItsSumsCannotHold) {
  EXPECT_THROW(ImageReducer(10, 13), std::invalid_argument);
  EXPECT_THROW(ImageReducer(10, 7), std::invalid_argument);
}

}  // namespace
}  // namespace hedgehop::vision::flow
