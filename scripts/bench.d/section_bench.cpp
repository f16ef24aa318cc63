#include <benchmark/benchmark.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "vision/sections/section_search.h"

namespace hedgehop::vision {
namespace {

const cv::Size kZed(1280, 720);        // [Perez2018] sec. III B
constexpr double kThresholdM = 9.144;  // 30 ft
constexpr double kMostShare = 0.15;

// Blocks of random depth, a fifth of them unknown.
cv::Mat random_depth() {
  cv::setNumThreads(1);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<float> depth_m(1.0f, 20.0f), chance(0.0f, 1.0f);
  cv::Mat depth(kZed, CV_32F);
  constexpr int kBlockPx = 16;
  for (int v = 0; v < kZed.height; v += kBlockPx) {
    for (int u = 0; u < kZed.width; u += kBlockPx) {
      const bool unknown = chance(random) < 0.2f;
      depth(cv::Rect(u, v, kBlockPx, kBlockPx)).setTo(unknown ? std::nanf("") : depth_m(random));
    }
  }
  return depth;
}

// [Perez2018] table 1: rows and columns of sections from 3 to 27. Those of 3 x 3 do not overlap.
void SectionSelection(benchmark::State& state) {
  const int count = static_cast<int>(state.range(0));
  sections::SectionGrid grid{.rows = count, .cols = count};
  if (count == 3) grid.width_share = grid.height_share = 1.0 / 3.0;
  sections::SectionSearch search(grid, kZed);
  const cv::Mat depth_m = random_depth();
  for (auto _ : state) {
    benchmark::DoNotOptimize(search.choose(depth_m, kThresholdM, kMostShare, sections::UnknownDepth::free));
  }
}
BENCHMARK(SectionSelection)->DenseRange(3, 27, 2)->Unit(benchmark::kMillisecond);

// Threats widened by 8 px to every side, the remedy for thin obstacles.
void SectionSelectionWidened(benchmark::State& state) {
  sections::SectionSearch search({.grow_px = 8}, kZed);
  const cv::Mat depth_m = random_depth();
  for (auto _ : state) {
    benchmark::DoNotOptimize(search.choose(depth_m, kThresholdM, kMostShare, sections::UnknownDepth::free));
  }
}
BENCHMARK(SectionSelectionWidened)->Unit(benchmark::kMillisecond);

// No selection can do without comparing each pixel once.
void SectionSelectionFloor(benchmark::State& state) {
  const cv::Mat depth_m = random_depth();
  cv::Mat mask;
  for (auto _ : state) {
    cv::compare(depth_m, kThresholdM, mask, cv::CMP_LT);
    benchmark::DoNotOptimize(mask.data);
  }
}
BENCHMARK(SectionSelectionFloor)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace hedgehop::vision

BENCHMARK_MAIN();
