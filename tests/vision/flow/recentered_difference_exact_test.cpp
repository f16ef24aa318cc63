#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "vision/flow/recentered_difference.h"

/// Compares every value with the same arithmetic pixel by pixel, because flights must be reproducible bit for bit.
namespace hedgehop::vision::flow {
namespace {

constexpr int kRim = 17;

struct Flow {
  std::vector<int32_t> u_q16, v_q16;
};

ReducedImage random_reduced_image(int width, int height, uint64_t seed) {
  std::mt19937_64 random(seed);
  ReducedImage image(width, height, kRim);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.row(y)[x] = static_cast<int16_t>(random() % 4081);
  }
  return image;
}

ReducedImage room_image(const char* side) {
  cv::Mat grey = cv::imread(std::string(HEDGEHOP_SOURCE_DIR "/tests/vision/images/") + side, cv::IMREAD_GRAYSCALE);
  cv::resize(grey, grey, {600, 120}, 0, 0, cv::INTER_CUBIC);
  ReducedImage image(grey.cols, grey.rows, kRim);
  ImageReducer(grey.cols, 12).smooth(grey, image);
  return image;
}

/// Random flow per column, or flow that varies slowly, as between patches.
Flow random_flow(int width, bool smooth, std::mt19937_64& random) {
  std::uniform_real_distribution<double> px(-16.0, 16.0), slope(-0.08, 0.08);
  Flow flow{std::vector<int32_t>(static_cast<size_t>(padded(width)), 0), {}};
  flow.v_q16 = flow.u_q16;
  for (auto* values : {&flow.u_q16, &flow.v_q16}) {
    const double start = px(random), step = slope(random);
    for (int x = 0; x < width; ++x) {
      const double value = smooth ? std::clamp(start + step * x, -16.0, 16.0) : px(random);
      (*values)[static_cast<size_t>(x)] = static_cast<int32_t>(std::lrint(65536.0 * value));
    }
  }
  return flow;
}

int16_t expected(const ReducedImage& older, const ReducedImage& newer, int x, int y, const Flow& flow) {
  const auto i = static_cast<size_t>(x);
  const int at_x = 128 * x + ((flow.u_q16[i] + 256) >> 9), at_y = 128 * y + ((flow.v_q16[i] + 256) >> 9);
  if (at_x < 0 || at_y < 0 || at_x > 128 * (newer.width() - 1) || at_y > 128 * (newer.height() - 1)) return 0;
  const int16_t *upper = newer.row(at_y >> 7) + (at_x >> 7), *lower = upper + newer.stride();
  const int s = at_x & 127, t = at_y & 127;
  const int top = ((128 - s) * upper[0] + s * upper[1] + 8) >> 4;
  const int bottom = ((128 - s) * lower[0] + s * lower[1] + 8) >> 4;
  return static_cast<int16_t>(older.row(y)[x] - (((128 - t) * top + t * bottom + 512) >> 10));
}

void expect_exact(const ReducedImage& older, const ReducedImage& newer, bool smooth, uint64_t seed) {
  std::mt19937_64 random(seed);
  const int width = older.width();
  const PatchRange part{8, padded(width) / 2 / 8 * 8};
  for (int y = 0; y < older.height(); ++y) {
    const Flow flow = random_flow(width, smooth, random);
    std::vector<int16_t> all(flow.u_q16.size(), int16_t{7}), some(all);
    recentered_difference(older, newer, y, flow.u_q16.data(), flow.v_q16.data(), all.data());
    recentered_difference(older, newer, y, flow.u_q16.data(), flow.v_q16.data(), some.data(), part);
    for (int x = 0; x < width; ++x) {
      const auto i = static_cast<size_t>(x);
      ASSERT_EQ(all[i], expected(older, newer, x, y, flow)) << x << " " << y;
      ASSERT_EQ(some[i], x >= part.begin && x < part.end ? all[i] : 7) << x << " " << y;
    }
  }
}

TEST(RecenteredDifferenceExact, EqualsAPixelByPixelComputationForRandomImages) {
  for (const int width : {45, 400, 1100}) {
    const ReducedImage older = random_reduced_image(width, 60, 1), newer = random_reduced_image(width, 60, 2);
    for (const bool smooth : {false, true}) expect_exact(older, newer, smooth, static_cast<uint64_t>(width));
  }
}

TEST(RecenteredDifferenceExact, OfExtremesFitsItsSixteenBits) {
  ReducedImage older(64, 40, kRim), newer(64, 40, kRim);
  std::mt19937_64 random(4);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 64; ++x) {
      older.row(y)[x] = random() % 2 ? 4080 : 0;
      newer.row(y)[x] = random() % 2 ? 4080 : 0;
    }
  }
  for (const bool smooth : {false, true}) expect_exact(older, newer, smooth, 6);
}

TEST(RecenteredDifferenceExact, EqualsAPixelByPixelComputationForARoom) {
  for (const bool smooth : {false, true}) expect_exact(room_image("left.png"), room_image("right.png"), smooth, 5);
}

/// SpreadFlow's rows with one multiplication and rounding per value.
TEST(SpreadFlowExact, RoundsEachColumnIndependently) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> px(-16.0, 16.0);
  for (const int width : {43, 48, 400}) {
    const std::vector<double> node_u = {9.5, 10.0, 17.5, 40.5}, node_v = {3.0, 12.5, 12.75, 30.0};
    std::vector<double> flow(16);
    for (double& f : flow) f = px(random);
    SpreadFlow spread(node_u, node_v, width);
    spread.set(flow, flow);
    const auto line = [&](size_t row, int x) {
      size_t left = 0;
      while (left + 2 < node_u.size() && x >= node_u[left + 1]) ++left;
      const double share = std::clamp((x - node_u[left]) / (node_u[left + 1] - node_u[left]), 0.0, 1.0);
      const double* node = &flow[4 * row + left];
      return static_cast<double>(std::lrint((node[0] + share * (node[1] - node[0])) * 65536.0));
    };
    for (const int y : {0, 3, 5, 12, 13, 20, 30, 41}) {
      spread.go_to(y);
      size_t above = 0;
      while (above + 2 < node_v.size() && y >= node_v[above + 1]) ++above;
      const double share = std::clamp((y - node_v[above]) / (node_v[above + 1] - node_v[above]), 0.0, 1.0);
      for (int x = 0; x < width; ++x) {
        const double top = line(above, x), bottom = line(above + 1, x);
        ASSERT_EQ(spread.u_q16()[x], std::lrint(top + share * (bottom - top))) << x << " " << y;
        ASSERT_EQ(spread.v_q16()[x], spread.u_q16()[x]) << x << " " << y;
      }
    }
  }
}

}  // namespace
}  // namespace hedgehop::vision::flow
