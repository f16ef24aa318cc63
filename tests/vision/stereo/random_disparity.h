#pragma once

#include <algorithm>
#include <opencv2/core.hpp>
#include <random>

#include "vision/stereo/disparity.h"

namespace hedgehop::vision {

/// Disparity images of several kinds, by `kind` modulo 5: dense and smooth, dense noise, sparse, slanted planes with
/// holes, blocks in front of sky.
inline cv::Mat random_disparity(std::mt19937_64& random, cv::Size size, int kind) {
  const auto uniform = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  cv::Mat d(size, CV_16SC1, cv::Scalar(stereo::kNoDisparity));
  const int base = uniform(20, 300), slope_u = uniform(-4, 4), slope_v = uniform(-4, 4);
  const auto each = [&](auto value) {
    for (int v = 0; v < size.height; ++v) {
      for (int u = 0; u < size.width; ++u) d.at<int16_t>(v, u) = static_cast<int16_t>(value(u, v));
    }
  };
  switch (kind % 5) {
    case 0:
      each([&](int u, int v) { return std::max(0, base + slope_u * u / 4 + slope_v * v / 4); });
      break;
    case 1:
      each([&](int, int) { return uniform(0, 400); });
      break;
    case 2:
      each([&](int, int) { return uniform(0, 99) < 1 ? uniform(0, 400) : int{stereo::kNoDisparity}; });
      break;
    case 3:
      each([&](int u, int v) {
        return uniform(0, 9) < 3 ? int{stereo::kNoDisparity} : std::max(0, base + slope_u * u + slope_v * v);
      });
      break;
    default:
      each([&](int, int v) { return v < size.height / 2 ? 0 : base / 8; });
      for (int block = 0; block < 6; ++block) {
        const cv::Rect area(uniform(0, size.width - 1), uniform(0, size.height - 1), uniform(1, size.width / 3),
                            uniform(1, size.height / 3));
        d(area & cv::Rect({}, size)).setTo(uniform(-1, 400));
      }
  }
  return d;
}

}  // namespace hedgehop::vision
