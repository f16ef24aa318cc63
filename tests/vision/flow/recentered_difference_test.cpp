#include "vision/flow/recentered_difference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace hedgehop::vision::flow {
namespace {

constexpr int kWidth = 45, kHeight = 30, kRim = 8;

ReducedImage random_image(uint64_t seed) {
  std::mt19937_64 random(seed);
  ReducedImage image(kWidth, kHeight, kRim);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) image.row(y)[x] = static_cast<int16_t>(random() % 4081);
  }
  return image;
}

TEST(RecenteredDifference, EqualsBilinearInterpolationWrittenOut) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> flow(-6.0, 6.0);
  const ReducedImage older = random_image(1), newer = random_image(2);
  std::vector<int32_t> u(static_cast<size_t>(padded(kWidth))), v(u.size());
  std::vector<int16_t> out(u.size());
  for (int y = 0; y < kHeight; ++y) {
    // Flow in multiples of 1/128 px, so that the sampled position is exact.
    for (size_t x = 0; x < u.size(); ++x) {
      u[x] = static_cast<int32_t>(std::lround(flow(random) * 128)) * 512;
      v[x] = static_cast<int32_t>(std::lround(flow(random) * 128)) * 512;
    }
    recentered_difference(older, newer, y, u.data(), v.data(), out.data());
    for (int x = 0; x < kWidth; ++x) {
      const double at_x = x + u[static_cast<size_t>(x)] / 65536.0, at_y = y + v[static_cast<size_t>(x)] / 65536.0;
      const int16_t got = out[static_cast<size_t>(x)];
      if (at_x < 0 || at_y < 0 || at_x > kWidth - 1 || at_y > kHeight - 1) {
        ASSERT_EQ(got, 0);
        continue;
      }
      const int left = std::min(static_cast<int>(at_x), kWidth - 2),
                top = std::min(static_cast<int>(at_y), kHeight - 2);
      const double fx = at_x - left, fy = at_y - top;
      const double expected = (1 - fy) * ((1 - fx) * newer.row(top)[left] + fx * newer.row(top)[left + 1]) +
                              fy * ((1 - fx) * newer.row(top + 1)[left] + fx * newer.row(top + 1)[left + 1]);
      constexpr double kRounding = 0.6;  // the result is rounded, and 1/8 once before
      ASSERT_NEAR(got, older.row(y)[x] - expected, kRounding) << x << " " << y;
    }
  }
}

TEST(SpreadFlow, IsBilinearBetweenNodesAndConstantBeyond) {
  const std::vector<double> node_u = {5.5, 17.0, 29.5}, node_v = {4.0, 12.5, 20.0, 26.0};
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> value(-6.0, 6.0);
  std::vector<double> flow_u(12), flow_v(12);
  for (auto& f : flow_u) f = value(random);
  for (auto& f : flow_v) f = value(random);
  SpreadFlow spread(node_u, node_v, kWidth);
  spread.set(flow_u, flow_v);

  const auto place = [](const std::vector<double>& nodes, double at) {
    size_t i = 0;
    while (i + 2 < nodes.size() && at >= nodes[i + 1]) ++i;
    return std::pair{i, std::clamp((at - nodes[i]) / (nodes[i + 1] - nodes[i]), 0.0, 1.0)};
  };
  for (const int first : {0, 7}) {
    for (int y = first; y < kHeight; ++y) {
      spread.go_to(y);
      for (int x = 0; x < kWidth; ++x) {
        const auto [c, fx] = place(node_u, x);
        const auto [r, fy] = place(node_v, y);
        const auto bilinear = [&, c = c, fx = fx, r = r, fy = fy](const std::vector<double>& f) {
          return (1 - fy) * ((1 - fx) * f[3 * r + c] + fx * f[3 * r + c + 1]) +
                 fy * ((1 - fx) * f[3 * r + 3 + c] + fx * f[3 * r + 4 + c]);
        };
        constexpr double kSteps = 1e-3;  // additions in 1/65536 px
        ASSERT_NEAR(spread.u_q16()[x] / 65536.0, bilinear(flow_u), kSteps) << x << " " << y;
        ASSERT_NEAR(spread.v_q16()[x] / 65536.0, bilinear(flow_v), kSteps) << x << " " << y;
      }
    }
  }
}

TEST(SpreadFlow, OneNodeFillsTheImage) {
  const std::vector<double> node = {10.0}, flow_u = {1.25}, flow_v = {-0.5};
  SpreadFlow spread(node, node, kWidth);
  spread.set(flow_u, flow_v);
  for (int y = 0; y < kHeight; ++y) {
    spread.go_to(y);
    for (int x = 0; x < kWidth; ++x) {
      ASSERT_EQ(spread.u_q16()[x], 81920);
      ASSERT_EQ(spread.v_q16()[x], -32768);
    }
  }
}

}  // namespace
}  // namespace hedgehop::vision::flow
