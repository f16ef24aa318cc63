#include <benchmark/benchmark.h>

#include <numbers>
#include <opencv2/core/utility.hpp>

#include "avoidance/stereo_corridor/stereo_corridor.h"
#include "tests/avoidance/flow_balance/flow_rig.h"
#include "vision/stereo/stereo_matcher.h"

namespace hedgehop::avoidance {
namespace {

using Method = vision::stereo::StereoMatcherConfig::Method;
using stereo_corridor::make_stereo_corridor, stereo_corridor::StereoCorridorConfig;

constexpr int kWidthPx = 320, kHeightPx = 240;
constexpr double kFovRad = 64.0 * std::numbers::pi / 180.0;  // [Andert2007] sec. 2

StereoCorridorConfig config_of(const benchmark::State& state) {
  StereoCorridorConfig config;
  config.stereo.method = static_cast<Method>(state.range(0));
  config.stereo.disparities_px = 32;
  config.stereo.block_px = config.stereo.method == Method::block ? 9 : 5;
  return config;
}

Setup rig() {
  Setup setup = stereo_pair(kHeightPx, 10.0);
  for (MountedCamera& camera : setup.cameras) {
    camera.model = vision::camera::PinholeCamera::from_fov(kWidthPx, kHeightPx, kFovRad);
  }
  return setup;
}

/// Walls at three distances that leave gaps: no way straight on, so every step of the search has work to do.
std::vector<CameraFrame> pair_of_images(const Setup& setup, const NavigationState& navigation) {
  const vision::WaveTexture texture(7, 0.4, 6.0, 24);
  return see(setup, navigation, 0,
             {wall(12.0, 0.0, std::numbers::pi, 2.0), wall(18.0, 7.0, std::numbers::pi, 3.0),
              wall(24.0, -9.0, std::numbers::pi, 4.0), wall(70.0, 0.0, std::numbers::pi)},
             texture);
}

/// One decision, matching included; 0: block matcher, 1: semi-global.
void Decision320(benchmark::State& state) {
  cv::setNumThreads(1);
  const Setup setup = rig();
  const NavigationState navigation = level_flight({0.0, 0.0, -6.0}, 0.0, {5.0, 0.0});
  std::vector<CameraFrame> frames = pair_of_images(setup, navigation);
  const std::unique_ptr<Module> module = make_stereo_corridor(config_of(state));
  module->reset(setup);
  int64_t t_ns = 0;
  for (auto _ : state) {
    t_ns += 100'000'000;
    for (CameraFrame& frame : frames) frame.t_ns = t_ns;
    benchmark::DoNotOptimize(module->update({t_ns, frames, navigation, {{200.0, 0.0, -6.0}, 0.0}}));
  }
}
BENCHMARK(Decision320)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

/// The stereo matching alone, as the floor of the whole decision.
void Decision320Floor(benchmark::State& state) {
  cv::setNumThreads(1);
  const Setup setup = rig();
  const std::vector<CameraFrame> frames = pair_of_images(setup, level_flight({0.0, 0.0, -6.0}, 0.0, {5.0, 0.0}));
  vision::stereo::StereoMatcher matcher(config_of(state).stereo);
  cv::Mat disparity16;
  for (auto _ : state) {
    matcher.match(frames[0].image, frames[1].image, disparity16);
    benchmark::DoNotOptimize(disparity16.data);
  }
}
BENCHMARK(Decision320Floor)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

/// Matching against its own floor: every pixel compared with every candidate once, the best kept.
void Matching320(benchmark::State& state) { Decision320Floor(state); }
BENCHMARK(Matching320)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void Matching320Floor(benchmark::State& state) {
  cv::setNumThreads(1);
  const Setup setup = rig();
  const std::vector<CameraFrame> frames = pair_of_images(setup, level_flight({0.0, 0.0, -6.0}, 0.0, {5.0, 0.0}));
  const int disparities_px = config_of(state).stereo.disparities_px;
  cv::Mat difference, best;
  for (auto _ : state) {
    for (int d = 0; d < disparities_px; ++d) {
      const cv::Mat left = frames[0].image.colRange(d, kWidthPx), right = frames[1].image.colRange(0, kWidthPx - d);
      cv::absdiff(left, right, difference);
      if (d == 0) difference.copyTo(best);
      cv::Mat rest = best.colRange(d, kWidthPx);
      cv::min(rest, difference, rest);
    }
    benchmark::DoNotOptimize(best.data);
  }
}
BENCHMARK(Matching320Floor)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace hedgehop::avoidance

BENCHMARK_MAIN();
