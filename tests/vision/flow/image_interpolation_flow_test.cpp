#include "vision/flow/image_interpolation_flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <new>
#include <numbers>
#include <random>
#include <stdexcept>

#include "tests/vision/flow/flow_errors.h"

namespace {
size_t allocations = 0;  // in the entire test program, counted below
}  // namespace

// The address sanitizer replaces operator new itself, so that allocations cannot be counted with it.
#ifndef __SANITIZE_ADDRESS__
void* operator new(size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t) noexcept { std::free(memory); }
#endif

namespace hedgehop::vision::flow {
namespace {

Eigen::Vector2d polar(double length, double angle) { return {length * std::cos(angle), length * std::sin(angle)}; }

bool same(const FlowField& a, const FlowField& b) {
  return a.vectors.size() == b.vectors.size() && std::equal(a.vectors.begin(), a.vectors.end(), b.vectors.begin(),
                                                            [](const FlowVector& x, const FlowVector& y) {
                                                              return x.valid == y.valid && x.flow_px == y.flow_px &&
                                                                     x.center_px == y.center_px;
                                                            });
}

TEST(ImageInterpolationFlow, ErrsLessThan005PxForTexturedPlanesMovingUpTo2Px) {
  for (const double least_period : {6.0, 25.0}) {
    const WaveTexture texture(21, least_period, 200.0);
    ImageInterpolationFlow flow({}, kSize, kSize);
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    flow.update(shifted(texture, at));
    int step = 0;
    for (const double length : {0.0, 0.4, 0.9, 1.3, 2.0}) {
      const Eigen::Vector2d move = polar(length, 0.3 + 1.9 * step++);
      at += move;
      const Errors e = errors(flow.update(shifted(texture, at)), [&](const auto&) { return move; });
      EXPECT_EQ(e.valid, 256) << least_period << " " << length;
      EXPECT_LT(e.rms_px, 0.03) << least_period << " " << length;
      EXPECT_LT(e.largest_px, 0.08) << least_period << " " << length;
    }
  }
}

TEST(ImageInterpolationFlow, ErrsLessThan005PxWithPixelNoise) {
  const WaveTexture texture(22, 6.0, 200.0);
  const Eigen::Vector2d move(1.1, -0.7);
  cv::Mat first = shifted(texture, {0, 0}), second = shifted(texture, move);
  add_noise(first, 2.0, 1);
  add_noise(second, 2.0, 2);
  ImageInterpolationFlow flow({}, kSize, kSize);
  flow.update(first);
  const Errors e = errors(flow.update(second), [&](const auto&) { return move; });
  EXPECT_EQ(e.valid, 256);
  EXPECT_LT(e.rms_px, 0.05);
}

TEST(ImageInterpolationFlow, TracksMotionUpTo12Px) {
  const WaveTexture texture(23, 8.0, 200.0);
  ImageInterpolationFlow flow({}, kSize, kSize);
  for (const double length : {4.0, 8.0, 12.0}) {
    flow.reset();
    const Eigen::Vector2d move = polar(length, 0.8 * length);
    flow.update(shifted(texture, {0, 0}));
    const Errors e = errors(flow.update(shifted(texture, move)), [&](const auto&) { return move; });
    EXPECT_EQ(e.valid, 256) << length;
    EXPECT_LT(e.rms_px, 0.05) << length;
  }
}

TEST(ImageInterpolationFlow, IterationRemovesTheCurvatureErrorOfOnePass) {
  // The paper's algorithm: one pass, no re-centering. Waves of 14 px, seven reduced pixels.
  const auto waves = [](const Eigen::Vector2d& shift) {
    return draw_image(128, 128, [=](double u, double v) {
      constexpr double k = 2 * std::numbers::pi / 14.0;
      return 127 + 40 * std::sin(k * (u - shift.x())) + 40 * std::sin(k * (v - shift.y()));
    });
  };
  ImageInterpolationConfig config;
  config.rows = config.cols = 3;
  config.patch_px = 48;
  config.margin_px = 8;
  config.reduction = 2;
  config.levels = 1;
  config.iterations = 1;
  const Eigen::Vector2d move(1.0, 0.5);
  const auto mean_error = [&] {
    ImageInterpolationFlow flow(config, 128, 128);
    flow.update(waves({0, 0}));
    return errors(flow.update(waves(move)), [&](const auto&) { return move; }).rms_px / move.norm();
  };
  EXPECT_GT(mean_error(), 0.1);
  config.iterations = 4;
  EXPECT_LT(mean_error(), 0.03);
}

TEST(ImageInterpolationFlow, FollowsExpansionAndPlanarWarpsAtEveryPatch) {
  const WaveTexture texture(24, 8.0, 200.0);
  // Newer image(x) = older image(A (x - c) + c - shift): affine, so the flow at the older position is known exactly.
  Eigen::Matrix2d growth;
  growth << 1.012, 0.006, -0.004, 1.008;
  const Eigen::Vector2d middle(199.5, 199.5), shift(0.8, -0.5);
  const Eigen::Matrix2d back = growth.inverse();
  const auto older = shifted(texture, {0, 0});
  const auto newer = draw_image(kSize, kSize, [&](double u, double v) {
    const Eigen::Vector2d x = back * (Eigen::Vector2d(u, v) - middle - shift) + middle;
    return texture.grey(x.x(), x.y());
  });
  for (const int margin : {28, 0}) {
    ImageInterpolationConfig config;
    config.margin_px = margin;
    ImageInterpolationFlow flow(config, kSize, kSize);
    flow.update(older);
    const Errors e = errors(flow.update(newer), [&](const Eigen::Vector2d& x) -> Eigen::Vector2d {
      return growth * (x - middle) + middle + shift - x;
    });
    EXPECT_EQ(e.valid, 256) << margin;
    EXPECT_LT(e.rms_px, 0.05) << margin;
  }
}

TEST(ImageInterpolationFlow, MirroredImagesGiveMirroredFlow) {
  const WaveTexture texture(27, 8.0, 100.0);
  const Eigen::Vector2d move(1.2, 0.7);
  const auto mirrored = [](const cv::Mat& image) {
    cv::Mat other(image.size(), CV_8UC1);
    for (int v = 0; v < image.rows; ++v) {
      for (int u = 0; u < image.cols; ++u) other.at<uint8_t>(v, u) = image.at<uint8_t>(v, image.cols - 1 - u);
    }
    return other;
  };
  const auto first = shifted(texture, {0, 0}), second = shifted(texture, move);
  ImageInterpolationFlow flow({}, kSize, kSize), mirror({}, kSize, kSize);
  flow.update(first);
  flow.update(second);
  mirror.update(mirrored(first));
  mirror.update(mirrored(second));
  for (int row = 0; row < 16; ++row) {
    for (int col = 0; col < 16; ++col) {
      const FlowVector &a = flow.field().at(row, col), &b = mirror.field().at(row, 15 - col);
      constexpr double kRounding = 0.008;  // half a step of the re-centering, in full pixels
      EXPECT_NEAR(a.flow_px.x(), -b.flow_px.x(), kRounding);
      EXPECT_NEAR(a.flow_px.y(), b.flow_px.y(), kRounding);
    }
  }
}

TEST(ImageInterpolationFlow, OneRowOfPatchesReadsABandOnly) {
  const WaveTexture texture(28, 8.0, 100.0);
  ImageInterpolationConfig config;
  config.rows = 1;
  config.cols = 8;
  const Eigen::Vector2d move(1.5, -0.4);
  cv::Mat first = shifted(texture, {0, 0}), second = shifted(texture, move);
  ImageInterpolationFlow whole(config, kSize, kSize), blinded(config, kSize, kSize);
  whole.update(first);
  const Errors e = errors(whole.update(second), [&](const auto&) { return move; });
  EXPECT_EQ(e.valid, 8);
  EXPECT_LT(e.rms_px, 0.05);

  // 64 rows of patches and a border: rows above 130 and below 270 are not read.
  for (cv::Mat* image : {&first, &second}) {
    image->rowRange(0, 130).setTo(0);
    image->rowRange(270, kSize).setTo(255);
  }
  blinded.update(first);
  blinded.update(second);
  EXPECT_TRUE(same(whole.field(), blinded.field()));
}

TEST(ImageInterpolationFlow, SmallImagesAndOddSizesWork) {
  struct Case {
    int width, height, rows, cols, patch, margin, reduction, levels;
  };
  const Case cases[] = {{200, 200, 16, 16, 32, 14, 2, 2}, {101, 77, 4, 5, 24, 3, 1, 2},  {64, 64, 3, 3, 16, 2, 1, 1},
                        {333, 250, 8, 8, 64, 10, 4, 2},   {400, 300, 8, 8, 96, 0, 2, 3}, {97, 203, 5, 2, 32, 5, 2, 1}};
  const Eigen::Vector2d move(0.9, -0.6);
  const WaveTexture texture(29, 14.0, 80.0);
  for (const Case& c : cases) {
    ImageInterpolationConfig config;
    config.rows = c.rows;
    config.cols = c.cols;
    config.patch_px = c.patch;
    config.margin_px = c.margin;
    config.reduction = c.reduction;
    config.levels = c.levels;
    ImageInterpolationFlow flow(config, c.width, c.height);
    flow.update(shifted(texture, {0, 0}, c.width, c.height));
    const Errors e = errors(flow.update(shifted(texture, move, c.width, c.height)), [&](const auto&) { return move; });
    EXPECT_GE(e.valid, c.rows * c.cols - 1) << c.width;
    EXPECT_LT(e.rms_px, 0.1) << c.width;
  }
}

TEST(ImageInterpolationFlow, EqualImagesGiveEqualBitsWithoutAllocation) {
  const WaveTexture texture(30, 8.0, 100.0);
  const auto first = shifted(texture, {0, 0}), second = shifted(texture, {1.0, 0.3});
  ImageInterpolationFlow a({}, kSize, kSize), b({}, kSize, kSize);
  a.update(second);
  a.update(first);
  b.update(first);
  const size_t before = allocations;
  a.update(second);
  const size_t after = allocations;
  b.update(second);
  EXPECT_EQ(after, before);
  EXPECT_TRUE(same(a.field(), b.field()));
}

TEST(ImageInterpolationFlow, RefusesWrongImagesAndConfigs) {
  ImageInterpolationFlow flow({}, kSize, kSize);
  EXPECT_THROW(flow.update(cv::Mat(300, kSize, CV_8UC1, cv::Scalar(0))), std::invalid_argument);
  EXPECT_THROW(flow.update(cv::Mat(kSize, kSize, CV_8UC3, cv::Scalar(0))), std::invalid_argument);
  const auto refuse = [](auto change) {
    ImageInterpolationConfig config;
    change(config);
    EXPECT_THROW(ImageInterpolationFlow(config, kSize, kSize), std::invalid_argument);
  };
  refuse([](auto& c) { c.rows = 0; });
  refuse([](auto& c) { c.patch_px = 600; });
  refuse([](auto& c) { c.patch_px = 8; });
  refuse([](auto& c) { c.margin_px = -1; });
  refuse([](auto& c) { c.reduction = 3; });
  refuse([](auto& c) { c.levels = 0; });
  refuse([](auto& c) { c.iterations = 0; });
  refuse([](auto& c) { c.max_flow_px = 0.0; });
  refuse([](auto& c) { c.noise_grey = std::nan(""); });
}

}  // namespace
}  // namespace hedgehop::vision::flow
