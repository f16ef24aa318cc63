#include <benchmark/benchmark.h>

#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "avoidance/landmark_map/landmark_map.h"
#include "tests/avoidance/flow_balance/flow_rig.h"

namespace hedgehop::avoidance {
namespace {

constexpr int kSidePx = 640;                                 // as in configs/shah2009_highrise_lateral.yaml
constexpr double kFovRad = 30.0 * std::numbers::pi / 180.0;  // [Shah2009] table 4.1

/// Three buildings before patches of grass, with noise.
cv::Mat image_of_buildings() {
  cv::setNumThreads(1);
  cv::RNG random(1);
  cv::Mat patches(kSidePx, kSidePx, CV_32FC1), image(kSidePx, kSidePx, CV_8UC3, cv::Scalar(70, 95, 45));
  random.fill(patches, cv::RNG::NORMAL, 0.0, 1.0);
  cv::GaussianBlur(patches, patches, {}, 3.0);
  cv::Mat grass;
  patches.convertTo(grass, CV_8U, 120.0, 60.0);
  cv::cvtColor(grass, grass, cv::COLOR_GRAY2RGB);
  image = 0.5 * image + 0.5 * grass;
  for (const int left : {60, 260, 460}) {
    const std::vector<cv::Point> wall = {{left, 200}, {left + 120, 190}, {left + 110, 560}, {left + 15, 580}};
    const std::vector<cv::Point> roof = {{left, 200}, {left + 70, 90}, {left + 120, 190}};
    cv::fillConvexPoly(image, wall, {150, 145, 140}, cv::LINE_AA);
    cv::fillConvexPoly(image, roof, {130, 65, 55}, cv::LINE_AA);
  }
  cv::Mat noise(image.size(), CV_16SC3), noisy;
  random.fill(noise, cv::RNG::NORMAL, 0.0, 2.0);
  cv::add(image, noise, noisy, {}, CV_8U);
  return noisy;
}

/// One decision of a flight that maps, its image included.
void LandmarkDecision640(benchmark::State& state) {
  const cv::Mat image = image_of_buildings();
  landmark_map::LandmarkMapModuleConfig config;
  config.observer.source = landmark_map::CornerSource::color;
  config.time_to_contact_s = 0.0;
  const std::unique_ptr<Module> module = landmark_map::make_landmark_map(config);
  Setup setup{{level_camera("front", 0.0, kSidePx, 10.0)}, {10.0, 5.0, 1.0}, 1};
  setup.cameras[0].model = vision::camera::PinholeCamera::from_fov(kSidePx, kSidePx, kFovRad);
  module->reset(setup);
  const NavigationState navigation = level_flight({0.0, 0.0, -40.0}, 0.0, {1.0, 0.0});
  std::vector<CameraFrame> frames = {{"front", 0, image}};
  int64_t t_ns = 0;
  for (auto _ : state) {
    frames[0].t_ns = t_ns += 100'000'000;
    benchmark::DoNotOptimize(module->update({t_ns, frames, navigation, {{200.0, 0.0, -40.0}, 0.0}}));
  }
}
BENCHMARK(LandmarkDecision640)->Unit(benchmark::kMillisecond);

/// No corner can be found without the gradient of both planes and its maxima.
void LandmarkDecision640Floor(benchmark::State& state) {
  const cv::Mat image = image_of_buildings();
  cv::Mat plane, smooth, dx, dy, maxima;
  for (auto _ : state) {
    for (int k = 0; k < 2; ++k) {
      cv::extractChannel(image, plane, k);
      cv::GaussianBlur(plane, smooth, {3, 3}, 0.0);
      cv::spatialGradient(smooth, dx, dy);
      cv::Canny(dx, dy, maxima, 50.0, 65.0, /*L2gradient=*/true);
      benchmark::DoNotOptimize(maxima.data);
    }
  }
}
BENCHMARK(LandmarkDecision640Floor)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace hedgehop::avoidance

BENCHMARK_MAIN();
