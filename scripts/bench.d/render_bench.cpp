#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "scenes/generators.h"
#include "sim/render/renderer.h"

// Cities and a room beside their floor: one textured quad that fills the image, as finely textured as trilinear
// filtering is dear (between two mipmap levels), drawn in the same run. Lenses of every kind beside the same floor, a
// pinhole's, by the pixel (counter Mpx a second).
namespace hedgehop::sim {
namespace {

constexpr double kPi = std::numbers::pi;
const vision::camera::PinholeCamera kCamera =
    vision::camera::PinholeCamera::from_fov(400, 400, kPi / 2);  // [Garratt2009] sec. 3.2
constexpr double kFlightHeightM = 10.0;

/// Camera looking along a heading, level.
Eigen::Isometry3d level(double north_m, double east_m, double height_m, double heading_rad) {
  Eigen::Isometry3d X_WC(Eigen::Translation3d(north_m, east_m, -height_m));
  X_WC.linear() << -std::sin(heading_rad), 0, std::cos(heading_rad),  //
      std::cos(heading_rad), 0, std::sin(heading_rad),                //
      0, 1, 0;
  return X_WC;
}

/// Straight down, north on top.
Eigen::Isometry3d down(double north_m, double east_m, double height_m) {
  Eigen::Isometry3d X_WC(Eigen::Translation3d(north_m, east_m, -height_m));
  X_WC.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  return X_WC;
}

/// Eight headings at each of six crossings near the middle, the same for every size of city.
std::vector<Eigen::Isometry3d> street_views(double height_m) {
  std::vector<Eigen::Isometry3d> poses;
  for (const double north_m : {-60.0, 0.0, 60.0}) {
    for (const double east_m : {-30.0, 30.0}) {
      for (int k = 0; k < 8; ++k) poses.push_back(level(north_m, east_m, height_m, k * kPi / 4 + 0.1));
    }
  }
  return poses;
}

/// Left, right, front, rear and down, all along a flight.
std::vector<Eigen::Isometry3d> five_cameras_in_flight() {
  std::vector<Eigen::Isometry3d> poses;
  for (double north_m = -130.0; north_m <= 110.0; north_m += 20.0) {
    for (int k = 0; k < 4; ++k) poses.push_back(level(north_m, 80.0, kFlightHeightM, k * kPi / 2));
    poses.push_back(down(north_m, 80.0, kFlightHeightM));
  }
  return poses;
}

std::vector<Eigen::Isometry3d> room_views() {
  std::vector<Eigen::Isometry3d> poses;
  for (int k = 0; k < 8; ++k) poses.push_back(level(-1.0, 0.5, 1.5, k * kPi / 4));
  return poses;
}

const scenes::Scene& city(double extent_m) {
  const auto make = [](double extent) {
    scenes::worlds::UrbanConfig config;
    config.extent_m = extent;
    return scenes::make_scene(config, 1);
  };
  static const scenes::Scene small = make(300.0), large = make(3000.0);  // some 100 and 10,000 buildings
  return extent_m > 300.0 ? large : small;
}

const scenes::Scene& forest(int64_t trees) {
  const auto make = [](int64_t count) {
    return scenes::make_scene(scenes::worlds::ForestConfig{.trees = count, .keep_clear = {{0.0, 0.0, 2.0}}}, 1);
  };
  static const scenes::Scene small = make(100), large = make(10000);
  return trees > 100 ? large : small;
}

/// Eight headings at each of five places near the middle, the same for every size of forest.
std::vector<Eigen::Isometry3d> forest_views(double height_m) {
  std::vector<Eigen::Isometry3d> poses;
  for (const auto& [north_m, east_m] : {std::pair{0.0, 0.0}, {8.0, 8.0}, {8.0, -8.0}, {-8.0, 8.0}, {-8.0, -8.0}}) {
    for (int k = 0; k < 8; ++k) poses.push_back(level(north_m, east_m, height_m, k * kPi / 4 + 0.1));
  }
  return poses;
}

/// A plane 10 m below the eye with a number of texels to each pixel.
scenes::Scene quad(double texels_per_pixel) {
  scenes::Scene scene;
  scene.textures = {city(300.0).textures.front()};
  const double texels_per_m = texels_per_pixel * kCamera.focal_x_px / kFlightHeightM;
  const float half_m = 50.0f, repeats = static_cast<float>(texels_per_m * 50.0 / scene.textures.front().cols);
  scenes::Mesh& mesh = scene.meshes.emplace_back();
  mesh.material = "opaque";
  for (const auto& [north, east] : {std::pair{-1.f, -1.f}, {-1.f, 1.f}, {1.f, 1.f}, {1.f, -1.f}}) {
    scenes::Vertex& corner = mesh.vertices.emplace_back();
    corner.p_W = {half_m * north, half_m * east, 0.f};
    corner.uv = {repeats * north, repeats * east};
  }
  mesh.indices = {0, 1, 2, 0, 2, 3};
  mesh.chunks = {{Eigen::AlignedBox3f(mesh.vertices[0].p_W, mesh.vertices[2].p_W), 0, 6, false}};
  return scene;
}

/// What a scenario may ask for besides.
struct Extras {
  Shadows shadows = Shadows::none;
  int samples = 1;
};

/// Time of one image, the mean over the poses.
void draw(benchmark::State& state, const scenes::Scene& scene, const std::vector<Eigen::Isometry3d>& poses,
          const vision::camera::Camera& camera = kCamera, const Extras& extras = {}) {
  const auto channel = static_cast<Channel>(state.range(0));
  Renderer renderer(scene, Culling::frustum_and_horizon, ContextKind::osmesa, extras.shadows);
  cv::Mat image;
  const auto draw_from = [&](const Eigen::Isometry3d& X_WC) {
    renderer.draw({.camera = camera, .X_WC = X_WC, .channel = channel, .samples = extras.samples}, image);
  };
  for (const Eigen::Isometry3d& X_WC : poses) draw_from(X_WC);  // plans the lens
  double stretches = 0.0, triangles = 0.0;
  const auto images = static_cast<int64_t>(poses.size());
  while (state.KeepRunningBatch(images)) {
    for (const Eigen::Isometry3d& X_WC : poses) {
      draw_from(X_WC);
      benchmark::DoNotOptimize(image.data);
      stretches += static_cast<double>(renderer.drawn().stretches);
      triangles += static_cast<double>(renderer.drawn().triangles);
    }
  }
  state.counters["stretches"] = benchmark::Counter(stretches, benchmark::Counter::kAvgIterations);
  const double pixels =
      static_cast<double>(camera.width_px) * camera.height_px * static_cast<double>(state.iterations());
  state.counters["Mpx"] = benchmark::Counter(1e-6 * pixels, benchmark::Counter::kIsRate);
  state.counters["triangles"] = benchmark::Counter(triangles, benchmark::Counter::kAvgIterations);
}

void City(benchmark::State& state) { draw(state, city(300.0), street_views(kFlightHeightM)); }
void CityFloor(benchmark::State& state) { draw(state, quad(1.6), {down(0, 0, kFlightHeightM)}); }
void CityShadows(benchmark::State& state) {
  draw(state, city(300.0), street_views(kFlightHeightM), kCamera, {.shadows = Shadows::sun});
}
void CityShadowsFloor(benchmark::State& state) { City(state); }
void CityFourSamples(benchmark::State& state) {
  draw(state, city(300.0), street_views(kFlightHeightM), kCamera, {.samples = 4});
}
void CityFourSamplesFloor(benchmark::State& state) { City(state); }
// The small city is the large one's floor: what cannot be seen should cost nothing.
void LargeCity(benchmark::State& state) { draw(state, city(3000.0), street_views(kFlightHeightM)); }
void LargeCityFloor(benchmark::State& state) { City(state); }
void LargeCityAboveRoofs(benchmark::State& state) { draw(state, city(3000.0), street_views(60.0)); }
void LargeCityAboveRoofsFloor(benchmark::State& state) { draw(state, city(300.0), street_views(60.0)); }
void FiveCamerasInFlight(benchmark::State& state) { draw(state, city(300.0), five_cameras_in_flight()); }
void FiveCamerasInFlightFloor(benchmark::State& state) { CityFloor(state); }
void Room(benchmark::State& state) { draw(state, scenes::make_scene(scenes::worlds::RoomConfig{}, 1), room_views()); }
void RoomFloor(benchmark::State& state) { CityFloor(state); }
void Forest(benchmark::State& state) { draw(state, forest(100), forest_views(5.0)); }
void ForestFloor(benchmark::State& state) { CityFloor(state); }
// The small forest is the large one's floor.
void ForestLarge(benchmark::State& state) { draw(state, forest(10000), forest_views(5.0)); }
void ForestLargeFloor(benchmark::State& state) { Forest(state); }
void ForestLargeBelowCrowns(benchmark::State& state) { draw(state, forest(10000), forest_views(1.8)); }
void ForestLargeBelowCrownsFloor(benchmark::State& state) { draw(state, forest(100), forest_views(1.8)); }
void ForestLargeAboveCrowns(benchmark::State& state) { draw(state, forest(10000), forest_views(25.0)); }
void ForestLargeAboveCrownsFloor(benchmark::State& state) { draw(state, forest(100), forest_views(25.0)); }
// Nothing to filter between levels: the cheapest textured image there is.
void MagnifiedQuad(benchmark::State& state) { draw(state, quad(0.8), {down(0, 0, kFlightHeightM)}); }
void MagnifiedQuadFloor(benchmark::State& state) { CityFloor(state); }

/// 752 x 480 px and 190 degrees across.
vision::camera::Camera wide_fisheye() {
  const double focal_px = vision::camera::fisheye_focal_px({}, 752, 190.0 * kPi / 180.0);
  return {752, 480, vision::camera::FisheyeLens{focal_px, focal_px, 375.5, 239.5}};
}
/// The pinhole of the other figures with a common lens before it.
vision::camera::Camera distorted_pinhole() {
  vision::camera::PinholeLens lens{kCamera.focal_x_px, kCamera.focal_y_px, kCamera.center_u_px, kCamera.center_v_px};
  lens.k1 = -0.12;
  lens.k2 = 0.02;
  return {kCamera.width_px, kCamera.height_px, lens};
}
/// A pinhole of the fisheye's size that sees the quad's texels as kCamera does.
vision::camera::Camera wide_pinhole() {
  return vision::camera::PinholeCamera{752, 480, kCamera.focal_x_px, kCamera.focal_y_px, 375.5, 239.5};
}

void CityFisheye(benchmark::State& state) { draw(state, city(300.0), street_views(kFlightHeightM), wide_fisheye()); }
void CityFisheyeFloor(benchmark::State& state) { draw(state, quad(1.6), {down(0, 0, kFlightHeightM)}, wide_pinhole()); }
void CityDistorted(benchmark::State& state) {
  draw(state, city(300.0), street_views(kFlightHeightM), distorted_pinhole());
}
void CityDistortedFloor(benchmark::State& state) { CityFloor(state); }

void grey(benchmark::internal::Benchmark* b) {
  b->ArgName("grey")->Arg(0)->Unit(benchmark::kMillisecond)->MinTime(0.1);
}
void all_channels(benchmark::internal::Benchmark* b) {
  b->ArgName("grey0_color1_depth2")->DenseRange(0, 2)->Unit(benchmark::kMillisecond)->MinTime(0.1);
}
BENCHMARK(City)->Apply(all_channels);
BENCHMARK(CityFloor)->Apply(all_channels);
BENCHMARK(CityShadows)->Apply(grey);
BENCHMARK(CityShadowsFloor)->Apply(grey);
BENCHMARK(CityFourSamples)->Apply(grey);
BENCHMARK(CityFourSamplesFloor)->Apply(grey);
BENCHMARK(CityDistorted)->Apply(all_channels);
BENCHMARK(CityDistortedFloor)->Apply(all_channels);
BENCHMARK(CityFisheye)->Apply(all_channels);
BENCHMARK(CityFisheyeFloor)->Apply(all_channels);
BENCHMARK(LargeCity)->Apply(grey);
BENCHMARK(LargeCityFloor)->Apply(grey);
BENCHMARK(LargeCityAboveRoofs)->Apply(grey);
BENCHMARK(LargeCityAboveRoofsFloor)->Apply(grey);
BENCHMARK(FiveCamerasInFlight)->Apply(grey);
BENCHMARK(FiveCamerasInFlightFloor)->Apply(grey);
BENCHMARK(Room)->Apply(grey);
BENCHMARK(RoomFloor)->Apply(grey);
BENCHMARK(Forest)->Apply(grey);
BENCHMARK(ForestFloor)->Apply(grey);
BENCHMARK(ForestLarge)->Apply(grey);
BENCHMARK(ForestLargeFloor)->Apply(grey);
BENCHMARK(ForestLargeBelowCrowns)->Apply(grey);
BENCHMARK(ForestLargeBelowCrownsFloor)->Apply(grey);
BENCHMARK(ForestLargeAboveCrowns)->Apply(grey);
BENCHMARK(ForestLargeAboveCrownsFloor)->Apply(grey);
BENCHMARK(MagnifiedQuad)->Apply(grey);
BENCHMARK(MagnifiedQuadFloor)->Apply(grey);

}  // namespace
}  // namespace hedgehop::sim

BENCHMARK_MAIN();
