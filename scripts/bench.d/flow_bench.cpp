#include <benchmark/benchmark.h>

#include <array>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "vision/flow/image_interpolation_flow.h"

namespace hedgehop::vision {
namespace {

constexpr int kCameras = 5, kSidePx = 400;  // [Garratt2009] sec. 3.2

// Smoothed noise, and the same moved by a few pixels.
std::array<cv::Mat, 2> moved_texture() {
  cv::setNumThreads(1);
  std::mt19937_64 random(1);
  cv::Mat noise(kSidePx + 16, kSidePx + 16, CV_8UC1);
  for (auto pixel = noise.begin<uchar>(); pixel != noise.end<uchar>(); ++pixel) *pixel = static_cast<uchar>(random());
  cv::GaussianBlur(noise, noise, {0, 0}, 2.5);
  cv::normalize(noise, noise, 0, 255, cv::NORM_MINMAX);
  return {noise({8, 8, kSidePx, kSidePx}).clone(), noise({5, 6, kSidePx, kSidePx}).clone()};
}

// 16 x 16 vectors of 64 px patches in each of five images.
void FiveFlowFields(benchmark::State& state) {
  const std::array<cv::Mat, 2> images = moved_texture();
  std::vector<flow::ImageInterpolationFlow> flows;
  for (int i = 0; i < kCameras; ++i) flows.emplace_back(flow::ImageInterpolationConfig{}, kSidePx, kSidePx);
  size_t frame = 0;
  for (auto _ : state) {
    ++frame;
    for (flow::ImageInterpolationFlow& each : flows) benchmark::DoNotOptimize(each.update(images[frame % 2]));
  }
}
BENCHMARK(FiveFlowFields)->Unit(benchmark::kMillisecond);

// No flow can do without halving each image once and summing it once over its patches.
void FiveFlowFieldsFloor(benchmark::State& state) {
  const std::array<cv::Mat, 2> images = moved_texture();
  cv::Mat half, sums;
  for (auto _ : state) {
    for (int i = 0; i < kCameras; ++i) {
      cv::resize(images[static_cast<size_t>(i % 2)], half, {kSidePx / 2, kSidePx / 2}, 0, 0, cv::INTER_AREA);
      cv::boxFilter(half, sums, CV_32F, {32, 32}, {-1, -1}, false);
      benchmark::DoNotOptimize(sums.data);
    }
  }
}
BENCHMARK(FiveFlowFieldsFloor)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace hedgehop::vision

BENCHMARK_MAIN();
