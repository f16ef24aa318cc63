#include <benchmark/benchmark.h>

#include <numbers>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <utility>
#include <vector>

#include "avoidance/corridor_centering/corridor_centering.h"
#include "avoidance/flow_balance/flow_balance.h"
#include "avoidance/local_map/local_map.h"
#include "avoidance/section_grid/section_grid.h"
#include "avoidance/stereo_corridor/stereo_corridor.h"
#include "scenes/generators.h"
#include "tests/avoidance/flow_balance/flow_rig.h"
#include "vision/corridor/corridor_flow.h"
#include "vision/flow/feature_flow.h"
#include "vision/flow/flow_velocity.h"
#include "vision/flow/image_interpolation_flow.h"
#include "vision/stereo/stereo_matcher.h"

// Decision time of each module with images of its rig, and construction time of scenes.
namespace hedgehop::avoidance {
namespace {

using Frames = std::vector<CameraFrame>;
constexpr int64_t kPeriodNs = 100'000'000;
constexpr double kSpeedMps = 2.0;

std::vector<vision::TexturedPlane> court() {
  using std::numbers::pi;
  return {wall(9.0, 0.0, pi), wall(-6.0, 0.0, 0.0), wall(0.0, 5.0, -0.5 * pi), wall(0.0, -7.0, 0.5 * pi)};
}

struct Flight {
  explicit Flight(const Setup& its_setup, const std::vector<vision::TexturedPlane>& walls, double texture_m)
      : setup(its_setup) {
    cv::setNumThreads(1);
    const vision::WaveTexture texture(7, 0.15 * texture_m, texture_m, 24);
    for (const double north_m : {0.0, 0.1 * kSpeedMps}) {
      navigation.push_back(level_flight({north_m, 0.0, -1.5}, 0.0, {kSpeedMps, 0.0}));
      frames.push_back(see(setup, navigation.back(), 0, walls, texture));
    }
  }
  const CameraFrame& frame(size_t step, size_t camera) const { return frames[step % 2][camera]; }

  Setup setup;
  std::vector<NavigationState> navigation;  ///< at two places, in turn
  std::vector<Frames> frames;
};

/// Decisions on the two places' images in turn: backwards and forwards, each as much work as the other.
void decide(benchmark::State& state, Module& module, Flight flight) {
  module.reset(flight.setup);
  int64_t t_ns = 0;
  size_t step = 0;
  for (auto _ : state) {
    t_ns += kPeriodNs;
    Frames& frames = flight.frames[++step % 2];
    for (CameraFrame& frame : frames) frame.t_ns = t_ns;
    benchmark::DoNotOptimize(module.update({t_ns, frames, flight.navigation[step % 2], {{200.0, 0.0, -1.5}, 0.0}}));
  }
}

void FlowBalance(benchmark::State& state) {
  decide(state, *flow_balance::make_flow_balance({}), Flight(four_cameras(400, 10.0), court(), 1.5));
}
BENCHMARK(FlowBalance)->Unit(benchmark::kMillisecond);

// No flow can do without halving each image once and summing it once over its patches.
void halve_and_sum(benchmark::State& state, int images) {
  const Flight flight(four_cameras(400, 10.0), court(), 1.5);
  cv::Mat half, sums;
  for (auto _ : state) {
    for (int i = 0; i < images; ++i) {
      cv::resize(flight.frame(0, static_cast<size_t>(i)).image, half, {200, 200}, 0, 0, cv::INTER_AREA);
      cv::boxFilter(half, sums, CV_32F, {32, 32}, {-1, -1}, false);
      benchmark::DoNotOptimize(sums.data);
    }
  }
}
void FlowBalanceFloor(benchmark::State& state) { halve_and_sum(state, 4); }
BENCHMARK(FlowBalanceFloor)->Unit(benchmark::kMillisecond);

/// As sim::Velocimeter has it: 8 x 8 patches of the camera that looks down, and the velocity that fits them.
void GroundVelocity(benchmark::State& state) {
  const Flight flight(four_cameras(400, 10.0), court(), 1.5);
  const vision::camera::PinholeCamera lens = flight.setup.cameras[0].model.pinhole();
  Eigen::Isometry3d X_BC = vision::looking_down();
  vision::flow::ImageInterpolationFlow flow({.rows = 8, .cols = 8}, lens.width_px, lens.height_px);
  const vision::flow::FlowMotion motion{Eigen::Quaterniond::Identity(), {0.01, 0.02, 0.03}, 9.0, 0.1};
  size_t step = 0;
  for (auto _ : state) {
    const auto& field = flow.update(flight.frame(++step, 1).image);
    benchmark::DoNotOptimize(vision::flow::flow_velocity(field, lens, X_BC, motion));
  }
}
BENCHMARK(GroundVelocity)->Unit(benchmark::kMillisecond);
void GroundVelocityFloor(benchmark::State& state) { halve_and_sum(state, 1); }
BENCHMARK(GroundVelocityFloor)->Unit(benchmark::kMillisecond);

Flight corridor_flight() {
  Setup setup = fisheye_below(480, 10.0);
  setup.cameras[0].model = vision::whole_fisheye();
  return Flight(setup, vision::StraightCorridor{}.planes(), 0.8);
}

void CorridorCentering(benchmark::State& state) {
  decide(state, *corridor_centering::make_corridor_centering({}), corridor_flight());
}
BENCHMARK(CorridorCentering)->Unit(benchmark::kMillisecond);

// Its corners found and tracked by OpenCV, both ways.
void CorridorCenteringFloor(benchmark::State& state) {
  const Flight flight = corridor_flight();
  const vision::camera::Camera& camera = flight.setup.cameras[0].model;
  const vision::flow::FeatureFlowConfig config;
  const auto regions = vision::corridor::region_masks(camera, flight.setup.cameras[0].X_BC, {}, config.window_px / 2);
  size_t step = 0;
  for (auto _ : state) {
    ++step;
    benchmark::DoNotOptimize(vision::flow::feature_flow(flight.frame(step, 0).image, flight.frame(step + 1, 0).image,
                                                        regions, camera, config));
  }
}
BENCHMARK(CorridorCenteringFloor)->Unit(benchmark::kMillisecond);

Flight stereo_flight(int width_px, int height_px) {
  Setup setup = stereo_pair(height_px, 10.0);
  for (MountedCamera& camera : setup.cameras) {
    camera.model = vision::camera::PinholeCamera::from_fov(width_px, height_px, 1.2);
  }
  using std::numbers::pi;
  return Flight(
      setup, {wall(12.0, 0.0, pi, 2.0), wall(18.0, 7.0, pi, 3.0), wall(24.0, -9.0, pi, 4.0), wall(70.0, 0.0, pi)}, 6.0);
}

void matching_alone(benchmark::State& state, const Flight& flight, const vision::stereo::StereoMatcherConfig& config) {
  vision::stereo::StereoMatcher matcher(config);
  cv::Mat disparity16;
  size_t step = 0;
  for (auto _ : state) {
    ++step;
    matcher.match(flight.frame(step, 0).image, flight.frame(step, 1).image, disparity16);
    benchmark::DoNotOptimize(disparity16.data);
  }
}

// As configs/andert2007_tree_320.yaml.
stereo_corridor::StereoCorridorConfig corridor_config() {
  stereo_corridor::StereoCorridorConfig config;
  config.stereo.disparities_px = 32;
  return config;
}
void StereoCorridor320(benchmark::State& state) {
  decide(state, *stereo_corridor::make_stereo_corridor(corridor_config()), stereo_flight(320, 240));
}
BENCHMARK(StereoCorridor320)->Unit(benchmark::kMillisecond);
void StereoCorridor320Floor(benchmark::State& state) {
  matching_alone(state, stereo_flight(320, 240), corridor_config().stereo);
}
BENCHMARK(StereoCorridor320Floor)->Unit(benchmark::kMillisecond);

// As configs/perez2018_route_light.yaml.
section_grid::SectionGridConfig section_config() {
  section_grid::SectionGridConfig config;
  config.stereo.disparities_px = 32;
  config.stereo.block_px = 11;
  config.speck_px = 150;
  return config;
}
void SectionGrid640(benchmark::State& state) {
  decide(state, *section_grid::make_section_grid(section_config()), stereo_flight(640, 360));
}
BENCHMARK(SectionGrid640)->Unit(benchmark::kMillisecond);
void SectionGrid640Floor(benchmark::State& state) {
  matching_alone(state, stereo_flight(640, 360), section_config().stereo);
}
BENCHMARK(SectionGrid640Floor)->Unit(benchmark::kMillisecond);

// Of the rig in configs/rigs/local_map.yaml. It integrates velocities, so that these lead from place to place.
void LocalMap640(benchmark::State& state) {
  Flight flight = stereo_flight(640, 360);
  flight.navigation[0].v_WB_B_est *= -1.0;
  decide(state, *local_map::make_local_map({}), std::move(flight));
}
BENCHMARK(LocalMap640)->Unit(benchmark::kMillisecond);
void LocalMap640Floor(benchmark::State& state) {
  matching_alone(state, stereo_flight(640, 360), local_map::LocalMapConfig{}.stereo);
}
BENCHMARK(LocalMap640Floor)->Unit(benchmark::kMillisecond);

void make(benchmark::State& state, const auto& config) {
  for (auto _ : state) benchmark::DoNotOptimize(scenes::make_scene(config, 1).textures.images().data());
}
// No scene can do without writing the pixels of its textures.
void write_textures(benchmark::State& state, const auto& config) {
  const std::vector<cv::Mat> textures = scenes::make_scene(config, 1).textures.images();
  for (auto _ : state) {
    for (const cv::Mat& texture : textures) benchmark::DoNotOptimize(texture.clone().data);
  }
}
void City(benchmark::State& state) { make(state, scenes::worlds::UrbanConfig{.extent_m = 300.0}); }
void CityFloor(benchmark::State& state) { write_textures(state, scenes::worlds::UrbanConfig{.extent_m = 300.0}); }
void Room(benchmark::State& state) { make(state, scenes::worlds::RoomConfig{}); }
void RoomFloor(benchmark::State& state) { write_textures(state, scenes::worlds::RoomConfig{}); }
BENCHMARK(City)->Unit(benchmark::kMillisecond);
BENCHMARK(CityFloor)->Unit(benchmark::kMillisecond);
BENCHMARK(Room)->Unit(benchmark::kMillisecond);
BENCHMARK(RoomFloor)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace hedgehop::avoidance

BENCHMARK_MAIN();
