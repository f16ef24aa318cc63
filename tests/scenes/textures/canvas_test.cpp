#include "scenes/textures/canvas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hedgehop::scenes::textures {
namespace {

double rms_step(const cv::Mat1f& noise, int from_column, int to_column) {
  double sum = 0.0;
  for (int r = 0; r < noise.rows; ++r) sum += std::pow(noise(r, to_column) - noise(r, from_column), 2);
  return std::sqrt(sum / noise.rows);
}

TEST(FractalNoise, HasMeanZeroDeviationOne) {
  Random random(2);
  const cv::Mat1f noise = fractal_noise(256, {4, 4, 8, 0.8}, random);
  double mean = 0.0, square = 0.0;
  for (float x : noise) {
    mean += x / static_cast<double>(noise.total());
    square += static_cast<double>(x) * x / static_cast<double>(noise.total());
  }
  EXPECT_NEAR(mean, 0.0, 1e-4);
  EXPECT_NEAR(square, 1.0, 1e-4);
}

TEST(FractalNoise, StepsAcrossTheSeamAreLikeStepsInside) {
  Random random(3);
  const cv::Mat1f noise = fractal_noise(256, {3, 5, 7, 0.75}, random);
  const cv::Mat1f rotated = noise.t();
  for (const cv::Mat1f& n : {noise, rotated}) {
    std::vector<double> inside;
    for (int c = 0; c + 1 < n.cols; ++c) inside.push_back(rms_step(n, c, c + 1));
    EXPECT_LE(rms_step(n, n.cols - 1, 0), *std::max_element(inside.begin(), inside.end()));
    EXPECT_GE(rms_step(n, n.cols - 1, 0), *std::min_element(inside.begin(), inside.end()));
    EXPECT_LT(*std::max_element(inside.begin(), inside.end()), 0.7);  // unrelated columns would differ by sqrt(2)
  }
}

TEST(Canvas, BrushesWrapAroundTheEdges) {
  constexpr int kSize = 64;
  const auto painted = [](double shift) {
    Canvas canvas(kSize, 4.0, {0.2f, 0.3f, 0.4f});
    canvas.fill({shift - 0.4, shift - 0.7, 1.1, 0.9}, {0.9f, 0.1f, 0.5f}, 0.8);
    canvas.disc(shift, shift + 0.1, 0.5, {0.1f, 0.8f, 0.6f}, 0.7);
    canvas.fade({shift - 0.2, shift - 0.5, 0.3, 1.0}, {1.0f, 1.0f, 1.0f}, 0.9, 0.1);
    return canvas.finished();
  };
  const cv::Mat3b at_corner = painted(0.0), at_center = painted(2.0);
  for (int r = 0; r < kSize; ++r) {
    for (int c = 0; c < kSize; ++c)
      ASSERT_EQ(at_corner(r, c), at_center((r + kSize / 2) % kSize, (c + kSize / 2) % kSize));
  }
}

TEST(Canvas, PartlyCoveredPixelsGetTheirShare) {
  Canvas canvas(4, 4.0, {0.0f, 0.0f, 0.0f});
  canvas.fill({1.5, 1.25, 1.0, 1.0}, {1.0f, 1.0f, 1.0f});
  const cv::Mat3b image = canvas.finished();
  EXPECT_NEAR(image(1, 1)[0], 255 * 0.5 * 0.75, 1.0);
  EXPECT_NEAR(image(2, 1)[0], 255 * 0.5 * 0.25, 1.0);
  EXPECT_NEAR(image(1, 2)[0], 255 * 0.5 * 0.75, 1.0);
  EXPECT_EQ(image(0, 1)[0], 0);
}

TEST(Canvas, CopiesDoNotShareTheirPixels) {
  Canvas first(8, 1.0, {0.0f, 0.0f, 0.0f});
  Canvas second = first;
  second.fill({0.0, 0.0, 1.0, 1.0}, {1.0f, 1.0f, 1.0f});
  EXPECT_EQ(cv::norm(first.finished()), 0.0);
}

TEST(DerivedSeed, StreamsAreSplitMix64) {
  // First outputs of SplitMix64 from state 1234567, as published with the algorithm.
  EXPECT_EQ(derived_seed(1234567, 0), 6457827717110365317u);
  EXPECT_EQ(derived_seed(1234567, 1), 3203168211198807973u);
  EXPECT_EQ(derived_seed(1234567, 2), 9817491932198370423u);
}

}  // namespace
}  // namespace hedgehop::scenes::textures
